// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/discrepancy/effects_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QCoreApplication>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSplitter>
#include <QStackedWidget>
#include <QStyledItemDelegate>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <map>
#include <utility>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "core/discrepancy/effect_listing.h"
#include "core/discrepancy/effect_titles.h"
#include "core/machine/driver_words.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/words.h"
#include "widgets/common/wrap_layout.h"
#include "widgets/models/session_model.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/effect_editor.h"
#include "widgets/panels/discrepancy/effect_picture.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"

namespace spindrift::gui {
namespace {

constexpr int id_role = Qt::UserRole;
constexpr int words_role = Qt::UserRole + 1;  ///< what a search looks through
constexpr int debounce_ms = 250;
constexpr int row_height = 32;
constexpr int state_width = 32;
constexpr auto effects_file = "effects.json";

/// Titles of effects go on in further lines: QTreeView asks for the height of an item without saying its width.
class WrappedTitles : public QStyledItemDelegate {
 public:
  explicit WrappedTitles(QTreeWidget* tree) : QStyledItemDelegate(tree), tree_(*tree) {}
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    int levels = tree_.rootIsDecorated() ? 1 : 0;
    for (QModelIndex parent = index.parent(); parent.isValid(); parent = parent.parent()) ++levels;
    QStyleOptionViewItem whole = option;
    initStyleOption(&whole, index);
    whole.rect = QRect(0, 0, tree_.columnWidth(index.column()) - levels * tree_.indentation(), 1000);
    const int margin = tree_.style()->pixelMetric(QStyle::PM_FocusFrameHMargin, nullptr, &tree_) + 1;
    const int room = tree_.style()->subElementRect(QStyle::SE_ItemViewItemText, &whole, &tree_).width() - 2 * margin;
    const int lines =
        whole.fontMetrics.boundingRect(QRect(0, 0, std::max(1, room), 10000), Qt::TextWordWrap, whole.text).height();
    const int beside = row_height - whole.fontMetrics.height();
    return {0, std::max(row_height, lines + beside)};
  }

 private:
  QTreeWidget& tree_;
};

nlohmann::json emptyDocument() {
  return {{"format", "spindrift-effects"}, {"version", 1}, {"built_in", true}, {"effects", nlohmann::json::array()}};
}

const ObservationSet* observationsOf(const Campaign& campaign, const StoredEvaluation* evaluation) {
  if (campaign.observations) return &*campaign.observations;
  return evaluation != nullptr ? &evaluation->observations : nullptr;
}

/// The catalogue's effects and the user's own of a campaign; what is wrong with the latter is told.
EffectListing listingOf(const Campaign& campaign, const StoredEvaluation* evaluation, const nlohmann::json& edited) {
  EffectListing out;
  out.document = emptyDocument();
  const ObservationSet* observations = observationsOf(campaign, evaluation);
  const auto take = [&](EffectsAnswer answer) {
    out.effects = std::move(answer.effects);
    for (const std::string& w : answer.warnings) out.warnings << coreSentence(w);
  };
  try {
    if (edited.is_object()) {
      out.document = edited;
      out.own = OwnEffects::parse(edited.dump(), effects_file);
    } else if (!campaign.effects.empty()) {
      const JsonNode file = JsonNode::read(campaign.path(campaign.effects.string()));
      out.own = OwnEffects::read(campaign.path(campaign.effects.string()));
      out.document = file.value();
    }
    take(listEffects(campaign, observations, out.own));
  } catch (const InputError& wrong) {
    out.problem = coreSentence(wrong.what());
    if (out.own == nullptr || out.own->builtIn()) take(listEffects(campaign, observations, nullptr));
  }
  // Those that cannot be tried are listed too: they may be put right.
  for (std::size_t i = 0; out.own != nullptr && i < out.own->effects().size(); ++i) {
    const Effect& effect = out.own->effects()[i].effect;
    if (out.find(effect.id) == nullptr) out.effects.push_back(effect);
  }
  return out;
}

QString titleOfEffect(const Effect& effect) {
  return sentenceStart(effect.own ? QString::fromStdString(titleOf(effect)) : effectTitle(effect.id));
}

/// Drivers as they are written in effects.json, whether the log has them or not.
std::vector<std::vector<std::string>> writtenDrivers(const Effect& effect, const OwnEffects* own) {
  const OwnEffect* written = effect.own && own != nullptr ? own->find(effect.id) : nullptr;
  if (written == nullptr) return driversOf(effect);
  std::vector<std::vector<std::string>> out;
  for (const std::vector<OwnDriver>& alternative : written->drivers) {
    std::vector<std::string> inputs;
    for (const OwnDriver& driver : alternative) inputs.push_back(driver.text);
    out.push_back(std::move(inputs));
  }
  return out;
}

/// What the search makes of an effect.
QString stateOf(const EffectOptions& choice, const std::string& id, bool possible) {
  if (!choice.considers(id)) return EffectsPanel::tr("switched off: it is not named");
  if (std::find(choice.added.begin(), choice.added.end(), id) != choice.added.end())
    return EffectsPanel::tr("in the model");
  if (!possible) return EffectsPanel::tr("cannot be tried: nothing that these data hold drives it");
  return EffectsPanel::tr("is tried");
}

/// Everything there is to say about an effect, as a table of rich text.
QString detailsOf(const Effect& effect, const EffectListing& listing, const QString& state) {
  const OwnEffects* own = listing.own.get();
  const auto row = [](const QString& name, const QString& value) {
    if (value.isEmpty()) return QString();
    return QStringLiteral(
               "<tr><td style=\"color:%1;padding:2px 16px 2px 0\">%2</td><td style=\"padding:2px 0\">%3</td></tr>")
        .arg(theme().text_secondary.name(), name.toHtmlEscaped(), value);
  };
  const auto plain = [](const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); };
  const OwnEffect* written = effect.own && own != nullptr ? own->find(effect.id) : nullptr;
  QString html = QStringLiteral("<table cellspacing=\"0\">");
  html += row(EffectsPanel::tr("Physics"), coreSentence(effect.physics).toHtmlEscaped());
  html += row(EffectsPanel::tr("In the search"), state.toHtmlEscaped());
  html += row(EffectsPanel::tr("Id"), QString::fromStdString(effect.id).toHtmlEscaped());
  html += row(EffectsPanel::tr("Formula"), formulaText(effect.formula).toHtmlEscaped());
  QStringList gains;
  for (const ShapeColumn& column : effect.shape) gains << gainUnitText(column.gain_unit);
  gains.removeDuplicates();
  const QString sign = effect.sign > 0   ? EffectsPanel::tr("; positive for more of the driver")
                       : effect.sign < 0 ? EffectsPanel::tr("; negative for more of the driver")
                                         : QString();
  html += row(EffectsPanel::tr("Unit of gain"), (gains.join(QStringLiteral(", ")) + sign).toHtmlEscaped());
  const QString drivers = driverWords(writtenDrivers(effect, own));
  html += row(EffectsPanel::tr("Driven by"),
              drivers.isEmpty() ? (effect.variants.empty() && written == nullptr
                                       ? EffectsPanel::tr("nothing that this log holds: it cannot be tried")
                                       : EffectsPanel::tr("nothing that is logged"))
                                : drivers.toHtmlEscaped());
  QString dynamics =
      coreSentence(dynamicsInWords(written != nullptr ? std::string(toString(written->dynamics)) : dynamicsOf(effect)));
  if (effect.tau_s) {
    dynamics += EffectsPanel::tr(", time constant %1 s to %2 s").arg((*effect.tau_s)[0]).arg((*effect.tau_s)[1]);
  }
  html += row(EffectsPanel::tr("Dynamics"), dynamics.toHtmlEscaped());
  QStringList held;
  for (const std::string& id : effect.contains) {
    if (listing.find(id) != nullptr) held << effectTitle(id);  // others this machine cannot have
  }
  html += row(EffectsPanel::tr("Contains"), held.join(QStringLiteral(", ")).toHtmlEscaped());
  QStringList references;
  for (const std::string& reference : effect.references) references << plain(reference);
  html += row(EffectsPanel::tr("See"), references.join(QStringLiteral("<br>")));
  return html + QStringLiteral("</table>");
}

void fillGains(QComboBox* box, const Effect& effect) {
  const QSignalBlocker quiet(box);
  const int before = box->currentIndex();
  box->clear();
  for (std::size_t i = 0; i < effect.shape.size(); ++i)
    box->addItem(EffectsPanel::tr("Gain %1 of %2").arg(i + 1).arg(effect.shape.size()));
  box->setCurrentIndex(before >= 0 && before < box->count() ? before : 0);
  box->setVisible(box->count() > 1);
}

}  // namespace

const Effect* EffectListing::find(const std::string& id) const {
  const auto found = std::find_if(effects.begin(), effects.end(), [&](const Effect& e) { return e.id == id; });
  return found == effects.end() ? nullptr : &*found;
}

EffectsPanel::EffectsPanel(SessionModel& session, CampaignUndo& undo, QWidget* parent)
    : QWidget(parent), session_(session), draft_(session, undo, draft_name, [this] {
        showDraft();
        Q_EMIT editorWanted();
      }) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  stack_ = new QStackedWidget;
  column->addWidget(stack_);
  listing_.document = emptyDocument();
  makeBrowser();
  debounce_.setSingleShot(true);
  debounce_.setInterval(debounce_ms);
  connect(&debounce_, &QTimer::timeout, this, &EffectsPanel::checkEdited);
  connect(&ThemeNotifier::instance(), &ThemeNotifier::changed, this, &EffectsPanel::markStates);
}

void EffectsPanel::makeBrowser() {
  auto* list_card = new Card(tr("Effects of this machine"));
  count_ = makeLabel({}, "secondaryText");
  list_card->addToTitle(count_);
  search_ = new QLineEdit;
  search_->setPlaceholderText(tr("Search in titles, physics, formulas and drivers"));
  search_->setAccessibleName(tr("Search the effects"));
  search_->setClearButtonEnabled(true);
  list_card->body()->addWidget(search_);
  tree_ = new QTreeWidget;
  tree_->setAccessibleName(tr("Effects"));
  tree_->setColumnCount(2);
  tree_->setHeaderHidden(true);
  tree_->setWordWrap(true);
  tree_->setItemDelegate(new WrappedTitles(tree_));
  tree_->setIndentation(16);
  tree_->header()->setStretchLastSection(false);
  tree_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  tree_->header()->setSectionResizeMode(1, QHeaderView::Fixed);
  tree_->header()->resizeSection(1, state_width);
  tree_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  tree_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  tree_->setMinimumHeight(160);
  connect(tree_->header(), &QHeaderView::sectionResized, tree_, [this] { tree_->doItemsLayout(); });
  list_card->body()->addWidget(tree_, 1);
  built_in_ = new QCheckBox(tr("Use the built-in effects too"));
  built_in_->setToolTip(tr("Off: the search tries your own effects alone, for a device that is not a machine tool"));
  list_card->body()->addWidget(built_in_);
  auto* buttons = new WrapLayout;
  new_ = makeButton(tr("New effect …"), "plus");
  load_ = makeButton(tr("Load …"), "folder-open");
  load_->setToolTip(tr("Reads effects.json in place of your own effects as they are here"));
  save_ = makeButton(tr("Save as …"), "export");
  save_->setToolTip(tr("Writes your own effects as effects.json, for campaign.json or the command line"));
  original_ = makeButton(tr("Back to the campaign's"), "restore");
  original_->setToolTip(tr("Drops the effects as edited here; those that campaign.json names are used again"));
  for (QPushButton* button : {new_, load_, save_, original_}) buttons->addWidget(button);
  list_card->body()->addLayout(buttons);
  callout_ = new Callout;
  list_card->body()->addWidget(callout_);

  detail_ = new Card;
  gain_ = new QComboBox;
  gain_->setAccessibleName(tr("Gain that is drawn"));
  gain_->hide();
  detail_->addToTitle(gain_);
  edit_ = makeButton(tr("Edit …"), "edit");
  remove_ = makeButton(tr("Remove"), "trash");
  detail_->addToTitle(edit_);
  detail_->addToTitle(remove_);
  picture_ = new EffectPicture;
  picture_->setMinimumHeight(200);
  detail_->body()->addWidget(picture_, 3);
  details_ = new QLabel;
  details_->setWordWrap(true);
  details_->setTextFormat(Qt::RichText);
  details_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  details_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(details_);
  scroll->setMinimumHeight(120);
  detail_->body()->addWidget(scroll, 3);
  stack_->addWidget(makeSplitter(stack_, list_card, detail_, 10, 10));

  connect(search_, &QLineEdit::textChanged, this, &EffectsPanel::filter);
  connect(tree_, &QTreeWidget::currentItemChanged, this, &EffectsPanel::showEffect);
  connect(tree_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem*, int at) {
    if (filling_ || at != 0 || switch_queued_) return;
    switch_queued_ = true;  // a family switches all of its effects one after the other
    QTimer::singleShot(0, this, &EffectsPanel::switched);
  });
  connect(tree_, &QTreeWidget::itemDoubleClicked, this, [this] {
    const Effect* effect = listing_.find(chosen());
    if (effect != nullptr && effect->own) editEffect(effect->id);
  });
  connect(gain_, &QComboBox::activated, this, &EffectsPanel::showPicture);
  connect(built_in_, &QCheckBox::clicked, this, [this](bool on) {
    if (!on && listing_.document["effects"].empty()) {
      built_in_->setChecked(true);
      callout_->show(Tone::Attention,
                     tr("There is no effect of your own yet: without the built-in ones the search would "
                        "have nothing to try. Write or load one first."));
      return;
    }
    nlohmann::json document = listing_.document;
    document["built_in"] = on;
    storeDocument(on ? tr("use the built-in effects") : tr("leave out the built-in effects"), std::move(document));
  });
  connect(new_, &QPushButton::clicked, this, &EffectsPanel::newEffect);
  connect(edit_, &QPushButton::clicked, this, [this] { editEffect(chosen()); });
  connect(remove_, &QPushButton::clicked, this, [this] { removeEffect(chosen()); });
  connect(load_, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getOpenFileName(this, tr("Load effects"), {}, tr("Effects (*.json)"));
    if (!file.isEmpty()) loadFile(file);
  });
  connect(save_, &QPushButton::clicked, this, [this] {
    const QString file = QFileDialog::getSaveFileName(this, tr("Save effects"), QString::fromLatin1(effects_file),
                                                      tr("Effects (*.json)"));
    if (!file.isEmpty()) saveFile(file);
  });
  connect(original_, &QPushButton::clicked, this, [this] {
    EffectOptions after = session_.effects();
    after.effects = nullptr;
    Q_EMIT changeAsked(tr("go back to the campaign's effects"), after, false);
  });
  updateButtons();
}

bool EffectsPanel::busy() const {
  return list_work_.busy() || check_work_.busy() || debounce_.isActive() || switch_queued_ || picture_->busy() ||
         (editor_picture_ != nullptr && editor_picture_->busy());
}

bool EffectsPanel::editing() const {
  return stack_->currentIndex() == 1;
}

void EffectsPanel::refresh() {
  const auto campaign = session_.campaign();
  if (campaign == nullptr) return;
  const EffectOptions choice = session_.effects();
  if (listed_ && campaign == campaign_ && session_.evaluation() == evaluation_ &&
      choice.effects == effects_of_choice_) {
    markStates();
    showDraft();
    return;
  }
  if (campaign != campaign_ && (campaign_ == nullptr || campaign->folder != campaign_->folder)) closeEditor();
  campaign_ = campaign;
  evaluation_ = session_.evaluation();
  effects_of_choice_ = choice.effects;
  listed_ = true;
  list();
}

void EffectsPanel::list() {
  count_->setText(tr("listing …"));
  list_work_.ask(
      [this, campaign = campaign_, evaluation = evaluation_, edited = effects_of_choice_]() -> std::function<void()> {
        auto answer = std::make_shared<EffectListing>(listingOf(*campaign, evaluation.get(), edited));
        return [this, answer] {
          listing_ = std::move(*answer);
          knowOwnTitles(listing_.document);
          fillTree();
          sayState();
          showDraft();
        };
      });
}

void EffectsPanel::fillTree() {
  const std::string before = chosen_after_listing_.empty() ? chosen() : std::exchange(chosen_after_listing_, {});
  filling_ = true;
  tree_->clear();
  std::map<QString, QTreeWidgetItem*> families;
  const QString own_family = tr("Your own");
  for (const Effect& effect : listing_.effects) {
    const QString family = effect.own ? own_family : familyTitle(effect.id.substr(0, effect.id.find('.')));
    QTreeWidgetItem*& parent = families[family];
    if (parent == nullptr) {
      parent = new QTreeWidgetItem({family});
      parent->setFont(0, textFont(sizes::font_body, QFont::DemiBold));
      parent->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable | Qt::ItemIsAutoTristate);
    }
    auto* item = new QTreeWidgetItem(parent, {titleOfEffect(effect)});
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable | Qt::ItemNeverHasChildren);
    item->setCheckState(0, Qt::Checked);
    item->setToolTip(0, QStringLiteral("%1 (%2)").arg(item->text(0), QString::fromStdString(effect.id)));
    item->setData(0, id_role, QString::fromStdString(effect.id));
    QStringList words{item->text(0), family, QString::fromStdString(effect.id), coreSentence(effect.physics),
                      formulaText(effect.formula)};
    // Found by the words that are shown, and by those of files.
    const std::vector<std::vector<std::string>> drivers = writtenDrivers(effect, listing_.own.get());
    words << QString::fromStdString(effect.formula) << driverWords(drivers);
    for (const std::vector<std::string>& inputs : drivers)
      for (const std::string& input : inputs) words << QString::fromStdString(input);
    item->setData(0, words_role, words.join(QLatin1Char(' ')));
  }
  // The user's own first, the families by their names.
  if (const auto own = families.find(own_family); own != families.end()) {
    tree_->addTopLevelItem(own->second);
    families.erase(own);
  }
  for (const auto& [name, item] : families) tree_->addTopLevelItem(item);
  tree_->expandAll();
  filling_ = false;
  {
    const QSignalBlocker quiet(built_in_);
    built_in_->setChecked(listing_.document.value("built_in", true));
  }
  markStates();
  filter();
  QTreeWidgetItem* now = itemOf(before);
  if (now == nullptr && tree_->topLevelItemCount() > 0 && tree_->topLevelItem(0)->childCount() > 0)
    now = tree_->topLevelItem(0)->child(0);
  if (now != nullptr) tree_->setCurrentItem(now);
  showEffect();
}

QTreeWidgetItem* EffectsPanel::itemOf(const std::string& id) const {
  const QString wanted = QString::fromStdString(id);
  for (int f = 0; f < tree_->topLevelItemCount(); ++f) {
    for (int i = 0; i < tree_->topLevelItem(f)->childCount(); ++i) {
      QTreeWidgetItem* item = tree_->topLevelItem(f)->child(i);
      if (item->data(0, id_role).toString() == wanted) return item;
    }
  }
  return nullptr;
}

void EffectsPanel::markStates() {
  const EffectOptions choice = session_.effects();
  std::map<std::string, const Effect*> effects;
  for (const Effect& effect : listing_.effects) effects.emplace(effect.id, &effect);
  filling_ = true;
  for (int f = 0; f < tree_->topLevelItemCount(); ++f) {
    for (int i = 0; i < tree_->topLevelItem(f)->childCount(); ++i) {
      QTreeWidgetItem* item = tree_->topLevelItem(f)->child(i);
      const std::string id = item->data(0, id_role).toString().toStdString();
      const Effect* effect = effects[id];
      const bool on = choice.considers(id);
      const bool added = std::find(choice.added.begin(), choice.added.end(), id) != choice.added.end();
      const bool possible = effect != nullptr && !effect->variants.empty();
      item->setCheckState(0, on ? Qt::Checked : Qt::Unchecked);
      const QString state = stateOf(choice, id, possible);
      item->setToolTip(1, state);
      item->setData(1, Qt::AccessibleTextRole, state);
      item->setIcon(1, added && on       ? icon("check-circle", theme().good)
                       : on && !possible ? icon("blocked", theme().text_secondary)
                                         : QIcon());
      item->setForeground(0, on && possible ? theme().text : theme().text_secondary);
    }
  }
  filling_ = false;
  updateButtons();
  if (!chosen().empty()) showEffect();
}

void EffectsPanel::filter() {
  const QStringList words = search_->text().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  int shown = 0;
  int all = 0;
  filling_ = true;
  for (int f = 0; f < tree_->topLevelItemCount(); ++f) {
    QTreeWidgetItem* family = tree_->topLevelItem(f);
    int here = 0;
    for (int i = 0; i < family->childCount(); ++i) {
      QTreeWidgetItem* item = family->child(i);
      const QString text = item->data(0, words_role).toString();
      const bool found = std::all_of(words.begin(), words.end(),
                                     [&](const QString& word) { return text.contains(word, Qt::CaseInsensitive); });
      item->setHidden(!found);
      if (found) ++here;
      ++all;
    }
    family->setHidden(here == 0);
    // A box that also switched what is not seen would surprise.
    family->setFlags(words.isEmpty() ? family->flags() | Qt::ItemIsUserCheckable
                                     : family->flags() & ~Qt::ItemIsUserCheckable);
    shown += here;
  }
  filling_ = false;
  count_->setText(words.isEmpty() ? tr("%n effects", nullptr, static_cast<int>(all))
                                  : tr("%1 of %n effects", nullptr, static_cast<int>(all)).arg(shown));
}

void EffectsPanel::switched() {
  switch_queued_ = false;
  EffectOptions after = session_.effects();
  const nlohmann::json before = optionsJson(after);
  QStringList off;
  QStringList on;
  for (int f = 0; f < tree_->topLevelItemCount(); ++f) {
    for (int i = 0; i < tree_->topLevelItem(f)->childCount(); ++i) {
      const QTreeWidgetItem* item = tree_->topLevelItem(f)->child(i);
      const std::string id = item->data(0, id_role).toString().toStdString();
      const bool considered = item->checkState(0) == Qt::Checked;
      if (considered == after.considers(id)) continue;
      after.consider(id, considered);
      (considered ? on : off) << effectTitle(id);
    }
  }
  if (optionsJson(after) == before) return;
  const QString what = !off.isEmpty() && !on.isEmpty() ? tr("switch effects on and off")
                       : off.size() == 1               ? tr("leave out %1").arg(off.front())
                       : on.size() == 1                ? tr("consider %1 again").arg(on.front())
                       : !off.isEmpty() ? tr("leave out %n effects", nullptr, static_cast<int>(off.size()))
                                        : tr("consider %n effects again", nullptr, static_cast<int>(on.size()));
  Q_EMIT changeAsked(what, after, false);
}

std::string EffectsPanel::chosen() const {
  const QTreeWidgetItem* item = tree_->currentItem();
  return item == nullptr ? std::string() : item->data(0, id_role).toString().toStdString();
}

void EffectsPanel::choose(const std::string& id) {
  if (QTreeWidgetItem* item = itemOf(id)) {
    tree_->setCurrentItem(item);
    tree_->scrollToItem(item);
  }
}

void EffectsPanel::showEffect() {
  if (filling_) return;
  const Effect* effect = listing_.find(chosen());
  edit_->setVisible(effect != nullptr && effect->own);
  remove_->setVisible(effect != nullptr && effect->own);
  if (effect == nullptr) {
    gain_->hide();
    const QTreeWidgetItem* family = tree_->currentItem();
    detail_->setTitle(family != nullptr ? family->text(0) : tr("Effect"));
    picture_->clear(tr("The shape of an effect on the machine appears here when you choose one in the list."));
    details_->clear();
    return;
  }
  detail_->setTitle(titleOfEffect(*effect));
  details_->setText(detailsOf(*effect, listing_, itemOf(effect->id)->toolTip(1)));
  fillGains(gain_, *effect);
  showPicture();
}

void EffectsPanel::showPicture() {
  const Effect* effect = listing_.find(chosen());
  if (effect == nullptr || campaign_ == nullptr) return;
  picture_->show(*effect, campaign_->machine, static_cast<std::size_t>(std::max(0, gain_->currentIndex())));
}

void EffectsPanel::updateButtons() {
  const bool any = listing_.document.contains("effects") && listing_.document["effects"].is_array() &&
                   !listing_.document["effects"].empty();
  save_->setEnabled(any);
  original_->setVisible(campaign_ != nullptr && !campaign_->effects.empty() && effects_of_choice_.is_object());
}

void EffectsPanel::storeDocument(const QString& what, nlohmann::json document, const std::string& renamed_from,
                                 const std::string& renamed_to) {
  EffectOptions after = session_.effects();
  const bool built_in = document.value("built_in", true);
  std::vector<std::string> own;
  for (const nlohmann::json& entry : document["effects"]) own.push_back(entry.value("id", std::string()));
  // Names that are gone are neither in the model nor left out.
  for (auto* list : {&after.added, &after.rejected}) {
    if (!renamed_from.empty()) std::replace(list->begin(), list->end(), renamed_from, renamed_to);
    std::erase_if(*list, [&](const std::string& id) {
      return std::find(own.begin(), own.end(), id) == own.end() && !(built_in && effectTitleOf(id));
    });
  }
  if (own.empty()) document["built_in"] = true;
  const bool nothing = own.empty() && campaign_ != nullptr && campaign_->effects.empty();
  after.effects = nothing ? nlohmann::json() : std::move(document);
  Q_EMIT changeAsked(what, after, !renamed_to.empty());
}

void EffectsPanel::removeEffect(const std::string& id) {
  nlohmann::json document = listing_.document;
  nlohmann::json kept = nlohmann::json::array();
  for (nlohmann::json& entry : document["effects"]) {
    if (entry.value("id", std::string()) == id) continue;
    if (entry.contains("contains")) {
      nlohmann::json& held = entry["contains"];
      held.erase(std::remove(held.begin(), held.end(), nlohmann::json(id)), held.end());
    }
    kept.push_back(entry);
  }
  document["effects"] = std::move(kept);
  storeDocument(tr("remove %1").arg(effectTitle(id)), std::move(document));
}

void EffectsPanel::loadFile(const QString& file) {
  if (campaign_ == nullptr) return;
  check_work_.ask([this, campaign = campaign_, evaluation = evaluation_, file]() -> std::function<void()> {
    QString problem;
    nlohmann::json document;
    try {
      const std::filesystem::path path(file.toStdString());
      document = JsonNode::read(path).value();
      const auto own = OwnEffects::read(path);
      (void)listEffects(*campaign, observationsOf(*campaign, evaluation.get()), own);
    } catch (const InputError& wrong) {
      problem = coreSentence(wrong.what());
    }
    return [this, problem, document] {
      if (!problem.isEmpty()) {
        callout_->show(Tone::Bad, problem);
        return;
      }
      storeDocument(tr("load effects"), document);
    };
  });
}

void EffectsPanel::saveFile(const QString& file) {
  try {
    const std::filesystem::path path = std::filesystem::weakly_canonical(file.toStdString());
    const std::string root =
        campaign_ == nullptr ? std::string() : std::filesystem::weakly_canonical(campaign_->folder).string() + "/";
    if (campaign_ != nullptr && path.string().starts_with(root)) {
      throw InputError({path, ""}, "lies in the campaign folder, which is never written to; allowed: any other place.");
    }
    writeFileAtomically(path, listing_.document.dump(2) + "\n");
    callout_->show(Tone::Good, tr("Saved as %1.").arg(file));
  } catch (const InputError& wrong) {
    callout_->show(Tone::Bad, coreSentence(wrong.what()));
  }
}

void EffectsPanel::makeEditor() {
  editor_card_ = new Card;
  editor_ = new EffectEditor;
  editor_scroll_ = new QScrollArea;
  editor_scroll_->setWidgetResizable(true);
  editor_scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  editor_scroll_->setFrameShape(QFrame::NoFrame);
  editor_scroll_->setWidget(editor_);
  editor_card_->body()->addWidget(editor_scroll_, 1);

  auto* picture_card = new Card(tr("Shape on the machine"));
  editor_gain_ = new QComboBox;
  editor_gain_->setAccessibleName(tr("Gain that is drawn"));
  editor_gain_->hide();
  picture_card->addToTitle(editor_gain_);
  editor_picture_ = new EffectPicture;
  picture_card->body()->addWidget(editor_picture_, 1);
  editor_state_ = new Callout;
  picture_card->body()->addWidget(editor_state_);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  auto* cancel = makeButton(tr("Cancel"), nullptr);
  accept_ = makeButton(tr("Apply"), nullptr, "primary");
  accept_->setToolTip(tr("Puts the effect into the list; the next search tries it"));
  buttons->addStretch(1);
  buttons->addWidget(cancel);
  buttons->addWidget(accept_);
  picture_card->body()->addLayout(buttons);
  stack_->addWidget(makeSplitter(stack_, editor_card_, picture_card, 6, 5));

  connect(editor_, &EffectEditor::edited, this, &EffectsPanel::editorChanged);
  connect(editor_gain_, &QComboBox::activated, this, &EffectsPanel::showEditorPicture);
  connect(cancel, &QPushButton::clicked, this, &EffectsPanel::leaveEditor);
  connect(accept_, &QPushButton::clicked, this, &EffectsPanel::accept);
}

void EffectsPanel::leaveEditor() {
  if (hasUnsavedEdit()) draft_.discard();
  closeEditor();
}

void EffectsPanel::closeEditor() {
  debounce_.stop();
  check_work_.forget();
  edited_ = false;
  stack_->setCurrentIndex(0);
}

void EffectsPanel::newEffect() {
  openEditor({{"dynamics", "none"}, {"shape", nlohmann::json::array({{{"gain_unit", "um"}}})}}, {});
  if (editing()) editor_->id()->setFocus();
}

void EffectsPanel::editEffect(const std::string& id) {
  for (const nlohmann::json& entry : listing_.document["effects"]) {
    if (entry.value("id", std::string()) == id) {
      openEditor(entry, id);
      checkEdited();
      editor_->id()->setFocus();
      return;
    }
  }
}

void EffectsPanel::openEditor(const nlohmann::json& entry, const std::string& original) {
  if (campaign_ == nullptr) return;
  if (editor_ == nullptr) makeEditor();
  QStringList columns;
  if (campaign_->log)
    for (const std::string& name : campaign_->log->names()) columns << QString::fromStdString(name);
  original_id_ = original;
  edited_ = false;
  read_.reset();
  editor_->setColumns(columns);
  editor_->setEntry(entry);
  draft_.shown(typed());
  editor_card_->setTitle(original.empty() ? tr("New effect") : tr("Effect %1").arg(QString::fromStdString(original)));
  editor_gain_->hide();
  editor_picture_->clear(tr("The shape appears here as soon as its expressions can be read."));
  editor_state_->show(Tone::Neutral,
                      tr("Give an id and at least one expression. Everything is checked while you type."));
  accept_->setEnabled(false);
  stack_->setCurrentIndex(1);
}

nlohmann::json EffectsPanel::typed() const {
  return {{"entry", editor_->entry()}, {"original_id", original_id_}};
}

void EffectsPanel::showDraft() {
  const nlohmann::json draft = draft_.typed(listing_.document);
  if (draft.is_object() && campaign_ != nullptr) {
    if (editing() && edited_ && typed() == draft) return;
    openEditor(draft.value("entry", nlohmann::json()), draft.value("original_id", std::string()));
    edited_ = true;
    checkEdited();
    return;
  }
  if (hasUnsavedEdit()) closeEditor();
  if (draft_.ofAnother(listing_.document) != of_another_) sayState();
}

void EffectsPanel::sayState() {
  callout_->setAction({}, {});
  of_another_ = draft_.ofAnother(listing_.document);
  if (!of_another_) {
    if (listing_.problem.isEmpty()) {
      callout_->set(Tone::Attention, listing_.warnings.join(QLatin1Char(' ')));
    } else {
      callout_->show(Tone::Bad, listing_.problem);
    }
    return;
  }
  callout_->show(Tone::Attention, tr("An effect was being edited while the effects were others. Show it: it can be "
                                     "applied to these, or cancelled."));
  callout_->setAction(tr("Show it"), [this] {
    draft_.takeOver(listing_.document);
    showDraft();
  });
}

std::size_t EffectsPanel::editedIndex() const {
  const nlohmann::json& effects = listing_.document["effects"];
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!original_id_.empty() && effects[i].value("id", std::string()) == original_id_) return i;
  }
  return effects.size();
}

nlohmann::json EffectsPanel::editedDocument() const {
  nlohmann::json document = listing_.document;
  const nlohmann::json entry = editor_->entry();
  const std::size_t at = editedIndex();
  nlohmann::json& effects = document["effects"];
  if (at < effects.size()) {
    effects[at] = entry;
  } else {
    effects.push_back(entry);
  }
  // Others that contain it know it by its new name.
  if (!original_id_.empty() && entry["id"] != original_id_) {
    for (nlohmann::json& other : effects) {
      if (!other.contains("contains")) continue;
      for (nlohmann::json& id : other["contains"])
        if (id == original_id_) id = entry["id"];
    }
  }
  return document;
}

void EffectsPanel::editorChanged() {
  edited_ = true;
  draft_.keep(tr("change an effect"), listing_.document, typed());
  accept_->setEnabled(false);
  check_work_.forget();
  debounce_.start();
}

void EffectsPanel::showProblem(const InputError& wrong) {
  const std::string prefix = "$.effects[" + std::to_string(editedIndex()) + "].";
  const std::string& place = wrong.where().place;
  const QString sentence = coreSentence(wrong.what());
  accept_->setEnabled(false);
  editor_state_->setAction({}, {});
  if (place.starts_with(prefix) && editor_->showProblem(place.substr(prefix.size()), sentence)) {
    editor_state_->show(Tone::Bad, tr("Not right yet: see the field that is marked."));
    editor_state_->setAction(tr("Show"), [this] { showMarkedField(); });
    if (editor_->problemHasFocus()) QTimer::singleShot(0, this, &EffectsPanel::showMarkedField);
    return;
  }
  editor_->clearProblems();
  editor_state_->show(Tone::Bad, sentence);
}

void EffectsPanel::showMarkedField() {
  if (QWidget* problem = editor_->problemWidget()) editor_scroll_->ensureWidgetVisible(problem, 0, 56);
}

void EffectsPanel::showEditorPicture() {
  if (!read_ || campaign_ == nullptr) return;
  editor_picture_->show(*read_, campaign_->machine,
                        static_cast<std::size_t>(std::max(0, editor_gain_->currentIndex())));
}

void EffectsPanel::checkEdited() {
  if (!editing() || campaign_ == nullptr) return;
  std::shared_ptr<const OwnEffects> own;
  try {
    own = OwnEffects::parse(editedDocument().dump(), effects_file);
  } catch (const InputError& wrong) {
    showProblem(wrong);
    return;
  }
  const OwnEffect* mine = own->find(editor_->entry()["id"].get<std::string>());
  if (mine != nullptr) {
    read_ = mine->effect;
    fillGains(editor_gain_, *read_);
    showEditorPicture();
  }
  // Whether the log has the drivers and the expressions have a value at every point takes longer.
  check_work_.ask([this, campaign = campaign_, evaluation = evaluation_, own]() -> std::function<void()> {
    std::shared_ptr<InputError> wrong;
    QStringList warnings;
    std::size_t count = 0;
    try {
      const ObservationSet* observations = observationsOf(*campaign, evaluation.get());
      if (observations != nullptr) count = observations->points().size();
      const EffectsAnswer answer = listEffects(*campaign, observations, own);
      for (const std::string& w : answer.warnings) warnings << coreSentence(w);
    } catch (const InputError& e) {
      wrong = std::make_shared<InputError>(e);
    }
    return [this, wrong, warnings, count] {
      if (!editing() || debounce_.isActive()) return;
      if (wrong != nullptr) {
        showProblem(*wrong);
        return;
      }
      editor_->clearProblems();
      editor_state_->setAction({}, {});
      if (!warnings.isEmpty()) {
        editor_state_->show(Tone::Attention, warnings.join(QLatin1Char(' ')));
      } else if (count > 0) {
        editor_state_->show(Tone::Good, tr("It can be read, and has a value at all %n points observed.", nullptr,
                                           static_cast<int>(count)));
      } else {
        editor_state_->show(Tone::Good, tr("It can be read. There are no observations yet to evaluate it at."));
      }
      accept_->setEnabled(edited_);
    };
  });
}

void EffectsPanel::accept() {
  const nlohmann::json document = editedDocument();
  const std::string id = editor_->entry()["id"].get<std::string>();
  const std::string original = original_id_;
  closeEditor();
  search_->clear();
  chosen_after_listing_ = id;
  storeDocument(original.empty() ? tr("add the effect %1").arg(QString::fromStdString(id))
                                 : tr("edit the effect %1").arg(QString::fromStdString(id)),
                document, original, id);
}

std::vector<Exportable> EffectsPanel::exportables() {
  std::vector<Exportable> items;
  if (listing_.effects.empty()) return items;
  items.push_back({tr("Effects of this machine"), {QStringLiteral("json")}, [this](const QString& file) {
                     writeFileAtomically(file.toStdString(),
                                         effectsJson(listing_.effects, listing_.own.get()).dump(2) + "\n");
                   }});
  if (!picture_->empty()) {
    items.push_back({tr("Shape of the effect"),
                     {QStringLiteral("png"), QStringLiteral("svg"), QStringLiteral("pdf")},
                     [this](const QString& file) { picture_->exportTo(file); }});
  }
  return items;
}

}  // namespace spindrift::gui
