// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/pages/discrepancy/discrepancy_page.h"

#include <QHBoxLayout>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QStackedWidget>
#include <QTabWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/json_reader.h"
#include "widgets/commands/commands.h"
#include "widgets/common/core_sentence.h"
#include "widgets/common/parts.h"
#include "widgets/common/question.h"
#include "widgets/common/words.h"
#include "widgets/jobs/task_job.h"
#include "widgets/panels/common/effect_titles.h"
#include "widgets/panels/discrepancy/effects_panel.h"
#include "widgets/panels/discrepancy/gap_panel.h"
#include "widgets/panels/discrepancy/next_panel.h"
#include "widgets/panels/discrepancy/noise_panel.h"
#include "widgets/panels/discrepancy/remainder_panel.h"
#include "widgets/panels/discrepancy/simulation_panel.h"
#include "widgets/panels/discrepancy/what_panel.h"
#include "widgets/panels/discrepancy/where_panel.h"
#include "widgets/theme/numbers.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {
namespace {

constexpr auto discrepancy_result = "discrepancy";
constexpr auto option_name = "discrepancy";

constexpr qsizetype longest_large_sentence = 72;
constexpr int between_panels_ms = 30;

struct Sentence {
  QString text;
  QString note;
  Tone tone = Tone::Neutral;
};

QString gapSentence(const DiscrepancyGap& gap) {
  return DiscrepancyPage::tr("The rms falls from %1 to %2; the noise alone is %3.")
      .arg(sizeText(gap.rms_before_um, QStringLiteral("um")), sizeText(gap.rms_after_um, QStringLiteral("um")),
           sizeText(gap.noise_um, QStringLiteral("um")));
}

/// What is missing beside what has been added.
QString missingEffects(const DiscrepancyStory& story) {
  QStringList parts;
  for (const FoundEffect& e : story.effects) {
    if (e.forced) continue;
    std::vector<std::string> names{e.id};
    names.insert(names.end(), e.rivals.begin(), e.rivals.end());
    const QString text = effectTitles(names, DiscrepancyPage::tr("or"));
    parts << (names.size() > 1 ? DiscrepancyPage::tr("one of %1").arg(text) : text);
  }
  return parts.join(DiscrepancyPage::tr("; and "));
}

Sentence verdictOf(const DiscrepancyStory& story) {
  const bool added = !story.added.empty();
  const QString names = effectTitles(story.added, DiscrepancyPage::tr("and"));
  if (!story.decided) {
    return {DiscrepancyPage::tr("These data cannot decide what is missing."), titledSentence(story.message),
            Tone::Neutral};
  }
  const QString left =
      story.leftover.empty() ? QString() : DiscrepancyPage::tr("Remainder: %1. ").arg(titledSentence(story.leftover));
  switch (story.verdict) {
    case DiscrepancyVerdict::None:
      if (const NoiseEstimate* far = farAboveStated(story.noise); far != nullptr && story.gap.withinNoise()) {
        return {DiscrepancyPage::tr("Nothing stands out of the scatter of the readings, which is large."),
                DiscrepancyPage::tr("Readings of %1 scatter %2 times as much as their stated σ: what is smaller than "
                                    "the noise of %3 would not show. Check how they were taken.")
                    .arg(componentName(far->component), decimalText(far->scale, 'f', 0),
                         sizeText(story.gap.noise_um, QStringLiteral("um"))),
                Tone::Attention};
      }
      return {
          story.gap.withinNoise()
              ? DiscrepancyPage::tr("Measured and simulated agree within the noise.")
              : DiscrepancyPage::tr("Measured and simulated differ by no more than a rough simulation may be off by."),
          DiscrepancyPage::tr("The rms is %1, the noise %2. Nothing is missing.")
              .arg(sizeText(story.gap.rms_before_um, QStringLiteral("um")),
                   sizeText(story.gap.noise_um, QStringLiteral("um"))),
          Tone::Good};
    case DiscrepancyVerdict::Unknown:
      return {added ? DiscrepancyPage::tr(
                          "In addition to %1 something is missing that no effect of the catalogue explains.")
                          .arg(names)
                    : DiscrepancyPage::tr("Something is missing that no effect of the catalogue explains."),
              left + (added ? gapSentence(story.gap)
                            : DiscrepancyPage::tr("The rms is %1, the noise %2.")
                                  .arg(sizeText(story.gap.rms_before_um, QStringLiteral("um")),
                                       sizeText(story.gap.noise_um, QStringLiteral("um")))),
              Tone::Bad};
    case DiscrepancyVerdict::Named:
    case DiscrepancyVerdict::Ambiguous:
      break;
  }
  const FoundEffect* next = story.nextProposal();
  if (next == nullptr) {
    if (!story.leftover.empty()) {
      return {DiscrepancyPage::tr("With %1 something remains that cannot be named.").arg(names),
              gapSentence(story.gap) + QLatin1Char(' ') + left, Tone::Attention};
    }
    return {DiscrepancyPage::tr("With %1 the simulation agrees with the measurement.").arg(names),
            gapSentence(story.gap) + QLatin1Char(' ') + left, Tone::Good};
  }
  Sentence s;
  s.tone = Tone::Attention;
  s.text = added ? DiscrepancyPage::tr("In addition to %1 the simulation lacks: %2.").arg(names, missingEffects(story))
                 : DiscrepancyPage::tr("The simulation lacks: %1.").arg(missingEffects(story));
  if (story.proposed) {
    DiscrepancyGap gap = *story.proposed;
    const auto missing =
        std::count_if(story.effects.begin(), story.effects.end(), [](const auto& e) { return !e.forced; });
    QString sure = percentOf(next->confidence);
    if (!next->rivals.empty()) sure = DiscrepancyPage::tr("%1 that it is one of these").arg(sure);
    const QString gain = missing > 1 ? DiscrepancyPage::tr(
                                           "Confidence %1 for the first. Adding all of them takes the "
                                           "rms from %2 to %3; the noise alone is %4. %5")
                                     : DiscrepancyPage::tr(
                                           "Confidence %1. Adding it takes the rms from %2 to %3; the "
                                           "noise alone is %4. %5");
    s.note =
        gain.arg(sure, sizeText(added ? story.gap.rms_after_um : gap.rms_before_um, QStringLiteral("um")),
                 sizeText(gap.rms_after_um, QStringLiteral("um")), sizeText(gap.noise_um, QStringLiteral("um")), left);
  }
  return s;
}

}  // namespace

DiscrepancyPage::DiscrepancyPage(PageContext page_context, QWidget* parent)
    : Page(std::move(page_context), StepId::Discrepancy, parent), excluded_([this] { showExcluded(); }) {
  search_ = makeButton(tr("Search"), nullptr, "primary");
  search_->setToolTip(tr("Find where measurement and simulation disagree, and try every effect of the catalogue"));
  effects_button_ = makeButton(tr("Effects"), "table");
  effects_button_->setCheckable(true);
  effects_button_->setToolTip(
      tr("All effects that the search knows for this machine: look at them, switch them off, write your own"));
  addAction(effects_button_);
  addAction(search_);

  stack_ = new QStackedWidget;
  empty_ = new EmptyState("discrepancy", {}, {});
  stack_->addWidget(empty_);
  auto* told = new QWidget;
  auto* column = new QVBoxLayout(told);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(8);
  banner_ = new Card;
  auto* line = new QHBoxLayout;
  line->setSpacing(16);
  verdict_icon_ = new IconLabel(QStringLiteral("info"), Tone::Neutral, 32);
  line->addWidget(verdict_icon_, 0, Qt::AlignTop);
  auto* words = new QVBoxLayout;
  words->setSpacing(4);
  verdict_ = new WrappedLabel;
  verdict_->setProperty("role", QStringLiteral("bigNumber"));
  verdict_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  verdict_->setAccessibleName(tr("Verdict"));
  verdict_note_ = new WrappedLabel;
  verdict_note_->setProperty("role", QStringLiteral("instruction"));
  words->addWidget(verdict_);
  words->addWidget(verdict_note_);
  line->addLayout(words, 1);
  add_ = makeButton(tr("Add to the model"), nullptr, "primary");
  remove_ = makeButton(tr("Remove from the model"), "undo");
  line->addWidget(remove_, 0, Qt::AlignVCenter);
  line->addWidget(add_, 0, Qt::AlignVCenter);
  banner_->body()->addLayout(line);
  column->addWidget(banner_);

  tabs_ = makeTabs(told);
  where_ = new WherePanel;
  gap_ = new GapPanel;
  nothing_yet_ = new EmptyState("discrepancy", {}, {});
  nothing_yet_->setObjectName(QStringLiteral("nothingYet"));
  tabs_->addTab(nothing_yet_, tr("What is missing"));
  tabs_->addTab(where_, tr("Where"));
  tabs_->addTab(gap_, tr("Gap before and after"));
  column->addWidget(tabs_, 1);
  stack_->addWidget(told);
  content()->addWidget(stack_, 1);
  showHints(where_);
  showHints(gap_);
  connect(tabs_, &QTabWidget::currentChanged, this, &DiscrepancyPage::arrangeTabs);

  connect(search_, &QPushButton::clicked, this, [this] {
    if (!mayBeLeft()) return;
    showEffects(false);
    search();
  });
  connect(effects_button_, &QPushButton::clicked, this, &DiscrepancyPage::showEffects);
  connect(add_, &QPushButton::clicked, this, &DiscrepancyPage::add);
  connect(remove_, &QPushButton::clicked, this, &DiscrepancyPage::removeLast);
  connect(gap_, &GapPanel::chosen, this, [this] {
    makePanels();
    where_->choose(gap_->point(), gap_->component());
    what_->choose(gap_->point(), gap_->component());
    remainder_->choose(gap_->point(), gap_->component());
  });
  connect(gap_, &GapPanel::timeChosen, where_, &WherePanel::markTime);
  connect(where_, &WherePanel::timeChosen, gap_, &GapPanel::chooseTime);
  connect(where_, &WherePanel::chosen, this, [this] {
    makePanels();
    gap_->choose(where_->point(), where_->component());
    what_->choose(where_->point(), where_->component());
    remainder_->choose(where_->point(), where_->component());
  });
  // Ids of results start again in every session.
  connect(&session(), &SessionModel::campaignChanged, this, [this] {
    story_.reset();
    shown_result_ = 0;
  });
  connect(&context().jobs, &JobRunner::started, this, &DiscrepancyPage::updateButtons);
  connect(&context().jobs, &JobRunner::finished, this, &DiscrepancyPage::updateButtons);
  connect(&session(), &SessionModel::workChanged, this, &DiscrepancyPage::updateButtons);  // asked for, and waits
}

QString DiscrepancyPage::missing() const {
  const auto campaign = session().campaign();
  if (campaign == nullptr) return tr("Open a session or a campaign first.");
  const bool simulation = !campaign->simulation.empty() || std::filesystem::exists(campaign->path("simulation.csv")) ||
                          std::filesystem::exists(campaign->path("model.json"));
  if (!simulation) {
    return tr(
        "This campaign comes without a simulation to compare with. Put simulation.csv or model.json beside "
        "campaign.json, name it there (\"simulation\": \"simulation.csv\") and open the campaign again.");
  }
  if (!session().observations()) {
    return tr("There are no observations to compare with the simulation. Evaluate the captures first (Calibrate).");
  }
  return {};
}

void DiscrepancyPage::refresh() {
  if (session().campaign() == nullptr) return;
  if (noticeCampaign()) {
    if (noise_ != nullptr) noise_->setExcluded({});
    if (effects_ != nullptr) effects_->closeEditor();
    showEffects(session().draft(EffectsPanel::draft_name).is_object());
  }
  knowTitles();
  if (effects_button_->isChecked()) effects_->refresh();
  const QString lacks = missing();
  callout()->setAction({}, {});
  if (!lacks.isEmpty()) {
    showNothing(tr("Nothing to compare yet"), lacks);
    return;
  }
  const StoredResult* stored = session().latest(discrepancy_result);
  if (!stored) {
    showNothing(tr("What does the simulation lack?"),
                tr("Press Search: every effect of the catalogue is fitted to the residual between measurement and "
                   "simulation. It takes a few seconds, can be cancelled, and changes nothing."));
    return;
  }
  if (stored->id != shown_result_ || story_ == nullptr) {
    try {
      story_ = std::make_shared<const DiscrepancyStory>(DiscrepancyStory::parse(stored->payload));
      shown_result_ = stored->id;
    } catch (const InputError& e) {
      const QString why = coreSentence(e.what());
      showNothing(tr("What was found cannot be shown"), why);
      callout()->show(Tone::Attention, why);
      return;
    }
    show();
  }
  showExcluded();
  if (simulation_ != nullptr) simulation_->refresh();
  arrangeTabs();
  showContent(1);
  if (const ResultState state = session().state(discrepancy_result); !state.current) {
    callout()->show(Tone::Outdated, tr("Changed since this was found: %1.").arg(state.changed));
    callout()->setAction(tr("Search again"), [this] { search(); });
  } else if (!story_->warnings.empty()) {
    QString text = titledSentence(story_->warnings.front());
    if (story_->warnings.size() > 1) text += QLatin1Char(' ') + tr("And %1 more.").arg(story_->warnings.size() - 1);
    // Notes of a search that is done; what asks for attention is that nothing explains what was found.
    callout()->show(story_->verdict == DiscrepancyVerdict::Unknown ? Tone::Attention : Tone::Accent, text);
  } else {
    callout()->set(Tone::Neutral, {});
  }
  updateButtons();
}

void DiscrepancyPage::search() {
  makePanelsSoon();  // while the search runs
  runTask(discrepancy_result, {.failed =
                                   [this](const QString& sentence) {
                                     refresh();
                                     showFailure(sentence);
                                   },
                               .cancelled = [this] { refresh(); }});
}

void DiscrepancyPage::change(const QString& what, const EffectOptions& after) {
  context().undo.push(new OptionsCommand(session(), what, session().campaignKey(option_keys::discrepancy),
                                         optionsJson(after), [this] { choiceChanged(); }));
}

void DiscrepancyPage::changeEffects(const QString& what, const EffectOptions& after, bool typed) {
  std::unique_ptr<QUndoCommand> change =
      std::make_unique<OptionsCommand>(session(), what, session().campaignKey(option_keys::discrepancy),
                                       optionsJson(after), [this] { effectsChanged(); });
  if (typed) change = std::make_unique<ApplyCommand>(session(), EffectsPanel::draft_name, std::move(change));
  context().undo.push(change.release());
}

void DiscrepancyPage::effectsChanged() {
  refresh();
}

void DiscrepancyPage::showContent(int index) {
  content_index_ = index;
  stack_->setCurrentIndex(effects_button_->isChecked() ? stack_->indexOf(effects_) : index);
}

void DiscrepancyPage::showEffects(bool shown) {
  if (!shown && !mayBeLeft()) shown = true;
  effects_button_->setChecked(shown);
  if (shown && effects_ == nullptr) {
    effects_ = new EffectsPanel(session(), context().undo);
    stack_->addWidget(effects_);
    connect(effects_, &EffectsPanel::changeAsked, this, &DiscrepancyPage::changeEffects);
    connect(effects_, &EffectsPanel::editorWanted, this, [this] { showEffects(true); });
  }
  if (shown) effects_->refresh();
  showContent(content_index_);
}

bool DiscrepancyPage::mayBeLeft() {
  if (effects_ == nullptr || !effects_->hasUnsavedEdit()) return true;
  if (!goAhead({tr("Effects"), tr("The effect that is being edited has not been taken over."), tr("Discard"),
                &Preferences::ask_before_discarding},
               this))
    return false;
  effects_->leaveEditor();
  return true;
}

void DiscrepancyPage::knowTitles() {
  const auto campaign = session().campaign();
  nlohmann::json now = session().effects().effects;
  if (!now.is_object()) now = campaign->effects.empty() ? "" : campaign->path(campaign->effects.string()).string();
  if (now == titles_of_) return;
  titles_of_ = now;
  try {
    knowOwnTitles(!now.is_string() ? now
                  : now == ""      ? nlohmann::json()
                                   : JsonNode::read(now.get<std::string>()).value());
  } catch (const InputError&) {
    knowOwnTitles(nullptr);  // the search says what is wrong with the file
  }
}

void DiscrepancyPage::choiceChanged() {
  refresh();
  // Undo does not wait: a search that was made with these effects before holds again.
  if (session().state(discrepancy_result).current) return;
  search();
  if (session().isRunning(discrepancy_result)) {
    callout()->setAction({}, {});
    callout()->show(Tone::Accent, tr("Fitting again with the effects as they are now. What is shown is of before."));
  }
}

void DiscrepancyPage::add() {
  if (story_ == nullptr) return;
  // What is marked in the table of effects (a rival, say), else the first that is proposed.
  std::string id = what_->chosen();
  if (id.empty() || what_->chosenIsAdded()) id = story_->nextProposal() != nullptr ? story_->nextProposal()->id : "";
  if (id.empty()) return;
  EffectOptions choice = session().effects();
  choice.added.push_back(id);
  tabs_->setCurrentWidget(gap_);
  change(tr("add %1").arg(effectTitle(id)), choice);
}

void DiscrepancyPage::removeLast() {
  EffectOptions choice = session().effects();
  if (choice.added.empty()) return;
  const QString title = effectTitle(choice.added.back());
  choice.added.pop_back();
  change(tr("remove %1").arg(title), choice);
}

void DiscrepancyPage::updateButtons() {
  // Behind other work it waits its turn.
  const bool idle = !session().isRunning(discrepancy_result);
  search_->setEnabled(idle && missing().isEmpty() && canRun(discrepancy_result));
  const bool proposes = story_ != nullptr && what_ != nullptr &&
                        (story_->nextProposal() != nullptr || (!what_->chosen().empty() && !what_->chosenIsAdded()));
  add_->setVisible(proposes);
  add_->setEnabled(idle && proposes);
  remove_->setVisible(story_ != nullptr && !story_->added.empty());
  remove_->setEnabled(idle);
  if (what_ != nullptr) what_->rejectButton()->setEnabled(idle);
  if (!proposes) return;
  std::string id = what_->chosen();
  if (id.empty() || what_->chosenIsAdded()) id = story_->nextProposal() != nullptr ? story_->nextProposal()->id : "";
  add_->setToolTip(id.empty() ? QString() : tr("Add %1 and fit all parameters again").arg(effectTitle(id)));
}

void DiscrepancyPage::makePanelsSoon() {
  QTimer::singleShot(between_panels_ms, this, [this] {
    if (makePanel()) makePanelsSoon();
  });
}

void DiscrepancyPage::makePanels() {
  while (makePanel()) {
  }
}

bool DiscrepancyPage::makePanel() {
  if (what_ == nullptr) {
    what_ = new WhatPanel;
    tabs_->insertTab(tabs_->indexOf(gap_), what_, tr("What is missing"));
    showHints(what_);
    connect(what_, &WhatPanel::choiceChanged, this, &DiscrepancyPage::updateButtons);
    connect(what_, &WhatPanel::rejectAsked, this, [this](const std::string& id) {
      EffectOptions choice = session().effects();
      choice.rejected.push_back(id);
      change(tr("leave out %1").arg(effectTitle(id)), choice);
    });
  } else if (noise_ == nullptr) {
    noise_ = new NoisePanel;
    tabs_->insertTab(tabs_->indexOf(gap_), noise_, tr("Noise"));
    showHints(noise_);
    connect(noise_, &NoisePanel::readingChosen, this,
            [this](const std::string& point, Component component, double time_s) {
              makePanels();
              choose(point, component);
              remainder_->choose(point, component);
              gap_->chooseTime(time_s);
              where_->markTime(time_s);
            });
    connect(noise_, &NoisePanel::excludeAsked, this, &DiscrepancyPage::toggleExcluded);
    showExcluded();
  } else if (remainder_ == nullptr) {
    remainder_ = new RemainderPanel;
    tabs_->insertTab(tabs_->indexOf(gap_), remainder_, tr("What remains"));
    showHints(remainder_);
    connect(remainder_, &RemainderPanel::chosen, this, [this] {
      makePanels();
      choose(remainder_->point(), remainder_->component());
    });
  } else if (simulation_ == nullptr) {
    makeSimulationPanel();
  } else if (next_ == nullptr) {
    next_ = new NextPanel;
    tabs_->addTab(next_, tr("What to measure next"));
  }
  arrangeTabs();
  return next_ == nullptr;
}

void DiscrepancyPage::makeSimulationPanel() {
  simulation_ = new SimulationPanel(context());
  tabs_->insertTab(tabs_->indexOf(gap_) + 1, simulation_, tr("Into the simulation"));
  showHints(simulation_);
  simulation_->refresh();
}

void DiscrepancyPage::showNothing(const QString& title, const QString& how) {
  story_.reset();
  shown_result_ = 0;
  callout()->set(Tone::Neutral, {});
  const bool measured = session().campaign() != nullptr && session().observations();
  (measured ? nothing_yet_ : empty_)->setTexts(title, how);
  if (measured) {
    arrangeTabs();
    if (simulation_ != nullptr) {
      simulation_->refresh();
    } else {
      // Nobody looks at it yet.
      QTimer::singleShot(between_panels_ms, this, [this] {
        if (simulation_ != nullptr || session().campaign() == nullptr) return;
        makeSimulationPanel();
        arrangeTabs();
      });
    }
  }
  showContent(measured ? 1 : 0);
  updateButtons();
}

void DiscrepancyPage::arrangeTabs() {
  const bool told = story_ != nullptr;
  QWidget* const first = told ? static_cast<QWidget*>(where_) : nothing_yet_;
  if (tabs_->currentWidget() != simulation_ && told == (tabs_->currentWidget() == nothing_yet_)) {
    tabs_->setTabVisible(tabs_->indexOf(first), true);
    tabs_->setCurrentWidget(first);
  }
  for (int i = 0; i < tabs_->count(); ++i) {
    const QWidget* tab = tabs_->widget(i);
    const bool visible = tab == simulation_ || told == (tab != nothing_yet_);
    if (visible != tabs_->isTabVisible(i)) tabs_->setTabVisible(i, visible);
  }
  // The verdict is about the simulation as it is; where it is changed there is no room for it.
  banner_->setVisible(told && tabs_->currentWidget() != simulation_);
}

void DiscrepancyPage::show() {
  makePanels();
  const auto campaign = session().campaign();
  where_->show(story_, &campaign->machine);
  what_->show(story_);
  gap_->show(story_, &campaign->machine);
  noise_->show(story_);
  remainder_->show(story_);
  gap_->choose(where_->point(), where_->component());
  what_->choose(where_->point(), where_->component());
  next_->show(story_);
  showVerdict();
}

void DiscrepancyPage::choose(const std::string& point, Component component) {
  where_->choose(point, component);
  what_->choose(point, component);
  gap_->choose(point, component);
}

void DiscrepancyPage::showExcluded() {
  if (noise_ == nullptr) return;  // show() fills it
  const std::map<QString, QString>& items = session().excluded();
  const auto set = session().observations();
  if (items.empty() || !set) return noise_->setExcluded({});
  const auto excluded = excluded_.ask(set, {}, [items](const ObservationSet& observations) {
    std::vector<ExcludedReading> found;
    for (std::size_t i = 0; i < observations.rows.size(); ++i) {
      const Observation& o = observations.rows[i];
      const auto item = items.find(itemOf(o.state, o.point, o.component));
      if (item == items.end()) continue;
      found.push_back({{i, o.time_s, o.state, o.point, o.component, o.value, std::nan("")}, item->second});
    }
    return found;
  });
  if (excluded != nullptr) noise_->setExcluded(*excluded);
}

void DiscrepancyPage::toggleExcluded() {
  if (noise_->chosenAreExcluded()) {
    excludeReadings({});
    return;
  }
  const QStringList items = noise_->chosenItems();
  if (items.isEmpty()) return;
  bool given = false;
  const QString reason =
      QInputDialog::getText(this, tr("Exclude readings"),
                            tr("Why are the readings %1 (state/point/component) left out? The report will say so.")
                                .arg(items.mid(0, 4).join(QStringLiteral(", ")) +
                                     (items.size() > 4 ? tr(" and %1 more").arg(items.size() - 4) : QString())),
                            QLineEdit::Normal, tr("outlier"), &given);
  if (given && !reason.trimmed().isEmpty()) excludeReadings(reason.trimmed());
}

void DiscrepancyPage::excludeReadings(const QString& reason) {
  makePanels();
  const QStringList items = noise_->chosenItems();
  if (!items.isEmpty()) context().undo.push(new ExcludeCommand(session(), items, reason));
}

void DiscrepancyPage::showVerdict() {
  const Sentence s = verdictOf(*story_);
  verdict_icon_->set(QString::fromLatin1(toneIcon(s.tone)), s.tone);
  // The longest sentences are set smaller, so that they stay within two lines.
  setRole(verdict_, s.text.size() > longest_large_sentence ? "pageTitle" : "bigNumber");
  verdict_->setText(onScreen(s.text));
  verdict_note_->setText(keptTogether(onScreen(s.note.trimmed())));
  verdict_note_->setVisible(!s.note.isEmpty());
}

std::vector<Exportable> DiscrepancyPage::exportables() {
  makePanels();
  std::vector<Exportable> items;
  if (effects_ != nullptr) items = effects_->exportables();
  if (story_ == nullptr) {
    for (Exportable& item : simulation_->exportables()) items.push_back(std::move(item));
    return items;
  }
  for (auto&& list : {where_->exportables(), what_->exportables(), noise_->exportables(), remainder_->exportables(),
                      gap_->exportables(), simulation_->exportables(), next_->exportables()}) {
    items.insert(items.end(), list.begin(), list.end());
  }
  const auto story = story_;
  items.push_back({tr("Discrepancy"), {QStringLiteral("json")}, [story](const QString& file) {
                     writeFileAtomically(file.toStdString(), story->result.dump(2) + "\n");
                   }});
  if (story_->result.at("model").is_object()) {
    items.push_back({tr("Model"), {QStringLiteral("json")}, [story](const QString& file) {
                       writeFileAtomically(file.toStdString(), story->result.at("model").dump(2) + "\n");
                     }});
  }
  return items;
}

}  // namespace spindrift::gui
