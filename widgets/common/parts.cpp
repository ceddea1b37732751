// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/parts.h"

#include <QButtonGroup>
#include <QCoreApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QHelpEvent>
#include <QPainter>
#include <QRegularExpression>
#include <QResizeEvent>
#include <QScrollBar>
#include <QSplitter>
#include <QStyledItemDelegate>
#include <QTabBar>
#include <QTabWidget>
#include <QTableView>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>
#include <vector>

#include "widgets/common/table_habits.h"
#include "widgets/common/table_titles.h"
#include "widgets/common/whole_rows.h"
#include "widgets/common/words.h"
#include "widgets/theme/fonts.h"
#include "widgets/theme/icons.h"
#include "widgets/theme/shown_units.h"

namespace spindrift::gui {

const char* toneIcon(Tone tone) {
  switch (tone) {
    case Tone::Good:
      return "check-circle";
    case Tone::Attention:
      return "alert";
    case Tone::Bad:
      return "error";
    case Tone::Outdated:
      return "outdated";
    default:
      return "info";
  }
}

IconLabel::IconLabel(QString name, Tone tone, int size, QWidget* parent)
    : QWidget(parent), name_(std::move(name)), tone_(tone), size_(size) {
  setFixedSize(size, size);
}

void IconLabel::set(const QString& name, Tone tone) {
  name_ = name;
  tone_ = tone;
  update();
}

void IconLabel::paintEvent(QPaintEvent*) {
  if (name_.isEmpty()) return;
  QPainter painter(this);
  painter.drawPixmap(0, 0, iconPixmap(name_, theme().tone(tone_), size_, devicePixelRatioF()));
}

OneLine::OneLine(const QString& text, QWidget* parent) : QLabel(text, parent) {
  setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
}

void OneLine::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setPen(palette().color(foregroundRole()));
  painter.drawText(rect(), Qt::AlignVCenter | Qt::AlignLeft, shown());
}

bool OneLine::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip && shown() != text()) {
    QToolTip::showText(static_cast<QHelpEvent*>(event)->globalPos(), text(), this);
    return true;
  }
  return QLabel::event(event);
}

WrappedLabel::WrappedLabel(QWidget* parent) : QLabel(parent) {
  setWordWrap(true);
}

void WrappedLabel::setText(const QString& text) {
  QLabel::setText(onScreen(text));
  keepLines();
}

bool WrappedLabel::event(QEvent* event) {
  const bool handled = QLabel::event(event);
  switch (event->type()) {
    case QEvent::Resize:
      if (static_cast<QResizeEvent*>(event)->oldSize().width() != width()) keepLines();
      break;
    case QEvent::Show:
    case QEvent::FontChange:
    case QEvent::StyleChange:
      keepLines();
      break;
    default:
      break;
  }
  return handled;
}

void WrappedLabel::keepLines() {
  if (!isVisible()) return;                      // its width is not yet known
  if (minimumHeight() > 0) setMinimumHeight(0);  // QLabel counts it in: a shorter text would stay as high
  setMinimumHeight(std::max(0, heightForWidth(width())));
}

Callout::Callout(QWidget* parent) : QFrame(parent) {
  auto* line = new QHBoxLayout(this);
  line->setContentsMargins(12, 10, 12, 10);
  line->setSpacing(10);
  icon_ = new IconLabel;
  text_ = new WrappedLabel;
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  button_ = new QPushButton;
  button_->hide();
  line->addWidget(icon_, 0, Qt::AlignTop);
  line->addWidget(text_, 1);
  line->addWidget(button_, 0, Qt::AlignVCenter);
  connect(button_, &QPushButton::clicked, this, [this] {
    if (action_) action_();
  });
  hide();
}

/// A sentence starts with a capital, unless it starts with a file name or an id.
static QString capitalised(QString sentence) {
  const qsizetype end = sentence.indexOf(QLatin1Char(' '));
  const QString word = end < 0 ? sentence : sentence.left(end);
  const bool plain = std::all_of(word.begin(), word.end(), [](QChar c) { return c.isLetter() && !c.isUpper(); });
  return plain ? sentenceStart(sentence) : sentence;
}

void Callout::show(Tone tone, const QString& sentence) {
  tone_ = tone;
  sentence_ = capitalised(sentence);
  text_->setText(keptTogether(sentence_));
  icon_->set(QString::fromLatin1(toneIcon(tone)), tone);
  setAccessibleName(onScreen(sentence));
  setVisible(true);
  update();
}

void Callout::set(Tone tone, const QString& sentence) {
  if (sentence.isEmpty()) {
    sentence_.clear();
    text_->clear();
    hide();
  } else {
    show(tone, sentence);
  }
}

void Callout::setAction(const QString& text, std::function<void()> action) {
  button_->setText(text);
  button_->setVisible(!text.isEmpty());
  action_ = std::move(action);
}

void Callout::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().toneSoft(tone_));
  painter.drawRoundedRect(rect(), 6, 6);
  painter.setBrush(theme().tone(tone_));
  painter.setClipRect(QRect(0, 0, 4, height()));
  painter.drawRoundedRect(rect(), 6, 6);
}

Badge::Badge(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
}

void Badge::set(const QString& icon_name, Tone tone, const QString& word) {
  icon_ = icon_name;
  tone_ = tone;
  word_ = onScreen(word);
  setAccessibleName(word_);
  updateGeometry();
  update();
}

QSize Badge::sizeHint() const {
  const QFontMetrics metrics(textFont(sizes::font_secondary, QFont::Medium));
  return {metrics.horizontalAdvance(word_) + 8 + 16 + 6 + 10, 26};
}

void Badge::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(theme().toneSoft(tone_));
  painter.drawRoundedRect(rect(), 13, 13);
  painter.drawPixmap(8, (height() - 16) / 2, iconPixmap(icon_, theme().tone(tone_), 16, devicePixelRatioF()));
  painter.setFont(textFont(sizes::font_secondary, QFont::Medium));
  painter.setPen(theme().tone(tone_));
  painter.drawText(QRect(30, 0, width() - 30, height()), Qt::AlignVCenter | Qt::AlignLeft, word_);
}

Card::Card(const QString& title, QWidget* parent) : QFrame(parent) {
  setProperty("role", QStringLiteral("card"));
  auto* outer = new QVBoxLayout(this);
  outer->setContentsMargins(16, 12, 16, 16);
  outer->setSpacing(8);
  title_line_ = new QHBoxLayout;
  title_line_->setSpacing(8);
  title_ = makeLabel(title, "sectionTitle");
  title_line_->addWidget(title_, 1);
  outer->addLayout(title_line_);
  body_ = new QVBoxLayout;
  body_->setSpacing(8);
  outer->addLayout(body_, 1);
  title_->setVisible(!title.isEmpty());
}

void Card::setTitle(const QString& title) {
  title_->setText(onScreen(title));
  title_->setVisible(!title.isEmpty());
}

void Card::addToTitle(QWidget* widget) {
  title_line_->addWidget(widget, 0);
}

NumberTile::NumberTile(const QString& name, QWidget* parent) : QFrame(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  auto* title = new WrappedLabel;  // in a narrow page it goes on in a second line
  title->setProperty("role", QStringLiteral("secondaryText"));
  title->setText(name);
  column->addWidget(title);
  value_ = makeLabel(QStringLiteral("–"), "bigNumber");
  value_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  note_ = new WrappedLabel;
  note_->setProperty("role", QStringLiteral("secondaryText"));
  column->addWidget(value_);
  column->addWidget(note_);
  column->addStretch(1);  // beside a tile with more lines its own stay on the same height
}

void NumberTile::set(const QString& value, const QString& note, Tone tone) {
  value_->setText(onScreen(value));
  note_->setText(note);
  note_->setVisible(!note.isEmpty());
  const QColor wanted = tone == Tone::Neutral ? theme().text : theme().tone(tone);
  QPalette colours = value_->palette();
  if (colours.color(QPalette::WindowText) == wanted) return;  // a new palette styles the label anew
  colours.setColor(QPalette::WindowText, wanted);
  value_->setPalette(colours);
}

EmptyState::EmptyState(const char* icon_name, const QString& title, const QString& how, QWidget* parent)
    : QWidget(parent) {
  auto* outer = new QVBoxLayout(this);
  outer->addStretch(1);
  layout_ = new QVBoxLayout;
  layout_->setSpacing(8);
  auto* icon_line = new QHBoxLayout;
  icon_line->addStretch();
  icon_line->addWidget(new IconLabel(QString::fromLatin1(icon_name), Tone::Neutral, 40));
  icon_line->addStretch();
  layout_->addLayout(icon_line);
  title_ = makeLabel(title, "sectionTitle");
  title_->setAlignment(Qt::AlignCenter);
  title_->setWordWrap(true);
  how_ = makeLabel(how, "instruction");
  how_->setAlignment(Qt::AlignCenter);
  how_->setWordWrap(true);
  layout_->addWidget(title_);
  layout_->addWidget(how_);
  outer->addLayout(layout_);
  outer->addStretch(1);
}

void EmptyState::setTexts(const QString& title, const QString& how) {
  title_->setText(title);
  how_->setText(onScreen(how));
}

QPushButton* EmptyState::addButton(const QString& text, bool primary) {
  auto* button = new QPushButton(text);
  if (primary) setRole(button, "primary");
  auto* line = new QHBoxLayout;
  line->addStretch();
  line->addWidget(button);
  line->addStretch();
  layout_->addSpacing(8);
  layout_->addLayout(line);
  return button;
}

QLabel* makeLabel(const QString& text, const char* role, QWidget* parent) {
  auto* label = new QLabel(onScreen(text), parent);
  label->setProperty("role", QString::fromLatin1(role));
  return label;
}

QPushButton* makeButton(const QString& text, const char* icon_name, const char* role) {
  // A thin space keeps the text away from the icon; style sheets have no word for that.
  auto* button = new QPushButton(icon_name == nullptr ? text : QChar(0x2009) + text);
  button->setProperty("role", QString::fromLatin1(role));
  button->setAccessibleName(text);
  if (icon_name != nullptr) {
    button->setIcon(icon(icon_name));
    button->setIconSize({sizes::icon, sizes::icon});
    drawIconOnAccent(*button, QLatin1String(role) == QLatin1String("primary"));
  }
  return button;
}

namespace {

constexpr int row_height = 32;
constexpr int fewest_rows = 3;

/// A table that says what will appear while it has no rows, and whose columns are all in sight: titles go on in a
/// second line where they have no room in one; where one column takes what the others leave, the widest of these give
/// way until it has room for its title. Numbers never do.
class QuietTable : public QTableView {
 public:
  /// The column that takes what the others leave; -1: none.
  [[nodiscard]] int stretched() const {
    for (int c = 0; model() != nullptr && c < horizontalHeader()->count(); ++c) {
      if (!isColumnHidden(c) && horizontalHeader()->sectionResizeMode(c) == QHeaderView::Stretch) return c;
    }
    return -1;
  }
  [[nodiscard]] bool holdsNumbers(int column) const {
    if (model() == nullptr || model()->rowCount() == 0) return false;
    return (model()->index(0, column).data(Qt::TextAlignmentRole).toInt() & Qt::AlignRight) != 0;
  }
  [[nodiscard]] QSize minimumSizeHint() const override {
    const QSize hint = QTableView::minimumSizeHint();
    const bool open = stretched() < 0 && (model() == nullptr || model()->rowCount() == 0);
    const int width = open ? 0 : leastWidth(true) + beside_columns;  // without rows nothing can be out of sight
    int rows = 0;
    for (int row = 0; row < fewest_rows; ++row)
      rows += row < verticalHeader()->count() ? rowHeight(row) : verticalHeader()->defaultSectionSize();
    const int bar = width > this->width() && horizontalScrollBarPolicy() != Qt::ScrollBarAlwaysOff
                        ? horizontalScrollBar()->sizeHint().height()
                        : 0;
    const int height =
        horizontalHeader()->sizeHint().height() + std::min(rows, most_asked_rows) + bar + 2 * frameWidth() + 2;
    return {std::max(hint.width(), std::min(width, most_asked_width)), std::max(hint.height(), height)};
  }
  /// What is in the cells has changed.
  void forgetWidths() {
    widths_.clear();
    words_.clear();
  }

 protected:
  void updateGeometries() override {
    // Without rows there is nothing to scroll to, whatever the last title takes.
    const bool empty = model() == nullptr || model()->rowCount() == 0;
    if (stretched() < 0) setHorizontalScrollBarPolicy(empty ? Qt::ScrollBarAlwaysOff : Qt::ScrollBarAsNeeded);
    if (auto* titles = dynamic_cast<TableTitles*>(horizontalHeader())) {
      const int last = titles->count() - 1;
      titles->fit(leastWidth(false), last >= 0 && stretched() < 0 ? leastWidthOf(last, true) : 0);
    }
    QTableView::updateGeometries();
    startWithAWholeRow();
    // Rows have got other heights.
    if (const int height = minimumSizeHint().height(); height != asked_height_) {
      asked_height_ = height;
      updateGeometry();
    }
  }
  void scrollContentsBy(int dx, int dy) override {
    QTableView::scrollContentsBy(dx, dy);
    startWithAWholeRow();
  }
  int sizeHintForColumn(int column) const override {
    const int wanted = contentWidth(column);
    const int stretch = stretched();
    if (stretch < 0 || stretch == column) return wanted;
    const int least = leastColumn(column, titleWidth(column));
    if (wanted <= least || holdsNumbers(column)) return wanted;
    std::vector<std::pair<int, int>> others;  // least, wanted
    for (int c = 0; c < horizontalHeader()->count(); ++c) {
      if (c == stretch || isColumnHidden(c)) continue;
      const int content = c == column ? wanted : contentWidth(c);
      others.emplace_back(holdsNumbers(c) ? content : leastColumn(c, titleWidth(c)), content);
    }
    // Sentences need the room of a few words, or their cells are columns of syllables.
    const int sentences = wordWrap() ? viewport()->width() * 2 / 5 : 0;
    const int room = viewport()->width() - std::max(leastColumn(stretch, titleWidth(stretch)), sentences);
    // The width to which columns are limited so that all of them fit, found from the widest down.
    int limit = wanted;
    const auto total = [&] {
      int sum = 0;
      for (const auto& [title, content] : others) sum += std::max(title, std::min(limit, content));
      return sum;
    };
    while (limit > least && total() > room) --limit;
    return limit;
  }
  void changeEvent(QEvent* event) override {
    if (event->type() == QEvent::FontChange || event->type() == QEvent::StyleChange) forgetWidths();
    QTableView::changeEvent(event);
  }
  bool viewportEvent(QEvent* event) override {
    if (event->type() == QEvent::ToolTip) {
      const auto* help = static_cast<QHelpEvent*>(event);
      const QModelIndex index = indexAt(help->pos());
      if (index.isValid() && index.data(Qt::ToolTipRole).toString().isEmpty() &&
          sizeHintForIndex(index).width() > visualRect(index).width()) {
        QToolTip::showText(help->globalPos(), index.data().toString(), this);
        return true;
      }
    }
    return QTableView::viewportEvent(event);
  }
  void paintEvent(QPaintEvent* event) override {
    QTableView::paintEvent(event);
    if (model() == nullptr) return;
    coverCutRows(*this);
    sayWhatIsEmpty(*this);
  }

 private:
  [[nodiscard]] int titleWidth(int column) const {
    const auto* titles = dynamic_cast<const TableTitles*>(horizontalHeader());
    return titleWidth(column, titles == nullptr || titles->narrow());
  }
  [[nodiscard]] int titleWidth(int column, bool narrow) const {
    if (isColumnHidden(column)) return 0;
    const auto* titles = dynamic_cast<const TableTitles*>(horizontalHeader());
    return std::max(horizontalHeader()->minimumSectionSize(), titles == nullptr
                                                                  ? horizontalHeader()->sectionSizeHint(column)
                                                                  : titles->titleWidth(column, narrow));
  }
  /// A column of texts that may go on in further lines or give way: as wide as its title and the longest word.
  [[nodiscard]] int leastColumn(int column, int title) const {
    return wordWrap() ? std::max(title, wordWidth(column)) : title;
  }
  /// All columns beside each other.
  [[nodiscard]] int leastWidth(bool narrow) const {
    int width = 0;
    for (int c = 0; model() != nullptr && c < horizontalHeader()->count(); ++c) {
      if (!isColumnHidden(c)) width += leastWidthOf(c, narrow);
    }
    return width;
  }
  [[nodiscard]] int leastWidthOf(int column, bool narrow) const {
    const bool whole = holdsNumbers(column) || (stretched() < 0 && !wordWrap());
    const int title = titleWidth(column, narrow);
    return whole ? std::max(title, contentWidth(column)) : leastColumn(column, title);
  }
  [[nodiscard]] int contentWidth(int column) const {
    widths_.resize(static_cast<std::size_t>(std::max(horizontalHeader()->count(), column + 1)), -1);
    int& width = widths_[static_cast<std::size_t>(column)];
    if (width >= 0) return width;
    width = std::max(0, QTableView::sizeHintForColumn(column));
    // The style sheet's check box is wider than the one the style counts with.
    const bool checks =
        model() != nullptr && model()->rowCount() > 0 && model()->index(0, column).data(Qt::CheckStateRole).isValid();
    if (checks) width += 16;
    return width;
  }

  /// The longest word of the cells with what stands beside it.
  [[nodiscard]] int wordWidth(int column) const {
    words_.resize(static_cast<std::size_t>(std::max(horizontalHeader()->count(), column + 1)), -1);
    int& width = words_[static_cast<std::size_t>(column)];
    if (width >= 0) return width;
    width = 0;
    static const QRegularExpression between(QStringLiteral("[ \\x{200b}]"));
    for (int row = 0; model() != nullptr && row < std::min(model()->rowCount(), most_rows_looked_at); ++row) {
      const QModelIndex index = model()->index(row, column);
      const auto* delegate = qobject_cast<const QStyledItemDelegate*>(itemDelegateForIndex(index));
      const QString text =
          delegate == nullptr ? index.data().toString() : delegate->displayText(index.data(), QLocale());
      const QVariant font = index.data(Qt::FontRole);
      const QFontMetrics metrics(font.isValid() ? font.value<QFont>() : this->font());
      const int beside = index.data(Qt::DecorationRole).isNull() ? 0 : iconWidth() + beside_icon;
      for (const QString& word : text.split(between))
        width = std::max(width, metrics.horizontalAdvance(word) + beside + around_text);
    }
    return width = std::min(width, longest_word);
  }

  /// Of the icon of a cell: that of the style where the view has none of its own.
  [[nodiscard]] int iconWidth() const {
    return iconSize().isValid() ? iconSize().width() : style()->pixelMetric(QStyle::PM_SmallIconSize, nullptr, this);
  }
  /// Scrolled to the end, Qt puts the last row at the bottom: the first one is cut then. Whole rows stand at the top.
  void startWithAWholeRow() {
    const QScrollBar& bar = *verticalScrollBar();
    if (verticalScrollMode() != ScrollPerItem || bar.maximum() == 0 || bar.value() != bar.maximum()) return;
    const int before = verticalHeader()->offset();
    verticalHeader()->setOffsetToSectionPosition(bar.value());
    if (verticalHeader()->offset() != before) viewport()->update();
  }

  static constexpr int beside_columns = 24;  ///< frame, scroll bar and padding of the style sheet
  static constexpr int beside_icon = 8;      ///< between an icon and its text, and around both
  static constexpr int around_text = 20;     ///< margins and the padding of the style sheet
  static constexpr int longest_word = 220;
  static constexpr int most_rows_looked_at = 200;
  static constexpr int most_asked_width = 500;
  static constexpr int most_asked_rows = 6 * row_height;
  mutable std::vector<int> widths_;  ///< of the cells of each column; -1: not looked at
  int asked_height_ = 0;
  mutable std::vector<int> words_;  ///< of the longest word in them
};

}  // namespace

QTableView* makeTable(QAbstractItemModel* model, const QString& accessible_name, const QString& empty_text) {
  auto* table = new QuietTable;
  table->setProperty("emptyText", empty_text);
  table->setHorizontalHeader(new TableTitles(table));
  // Before the view hears of it.
  const auto forget = [table] { table->forgetWidths(); };
  QObject::connect(model, &QAbstractItemModel::modelReset, table, forget);
  QObject::connect(model, &QAbstractItemModel::dataChanged, table, forget);
  QObject::connect(model, &QAbstractItemModel::layoutChanged, table, forget);
  QObject::connect(model, &QAbstractItemModel::rowsInserted, table, forget);
  QObject::connect(model, &QAbstractItemModel::rowsRemoved, table, forget);
  table->setModel(model);
  table->setAccessibleName(accessible_name);
  table->setShowGrid(false);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setTabKeyNavigation(false);
  table->setWordWrap(false);
  table->setVerticalScrollMode(QAbstractItemView::ScrollPerItem);  // whole rows at the top as well
  table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  table->verticalHeader()->hide();
  table->verticalHeader()->setDefaultSectionSize(row_height);
  table->verticalHeader()->setMinimumSectionSize(row_height);
  giveTableHabits(table);
  // Numbers stand beside the others, not at the far end of a wide table.
  const auto settle_last = [table] {
    QHeaderView* titles = table->horizontalHeader();
    if (titles->count() > 0 && titles->sectionResizeMode(titles->count() - 1) == QHeaderView::ResizeToContents &&
        table->stretched() < 0 && titles->stretchLastSection() == table->holdsNumbers(titles->count() - 1))
      titles->setStretchLastSection(!titles->stretchLastSection());
  };
  QObject::connect(model, &QAbstractItemModel::modelReset, table, [table, settle_last] {
    settle_last();
    table->updateGeometry();  // numbers ask for their width
  });
  QObject::connect(model, &QAbstractItemModel::dataChanged, table, settle_last);
  // Narrower columns need more lines.
  QObject::connect(
      table->horizontalHeader(), &QHeaderView::sectionResized, table,
      [table] {
        if (table->wordWrap() && table->verticalHeader()->sectionResizeMode(0) == QHeaderView::ResizeToContents)
          table->resizeRowsToContents();
      },
      Qt::QueuedConnection);
  return table;
}

namespace {

/// Cells whose texts go on in further lines: as high as their lines need beside the padding that the style sheet gives
/// to cells, of which Qt's own hint knows nothing. Names of files and parameters go on after their dots and strokes, a
/// value stays with its uncertainty and unit.
class WrappedCells : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;
  [[nodiscard]] QString displayText(const QVariant& value, const QLocale& locale) const override {
    static const QRegularExpression joints(QStringLiteral("(?<=\\w)([._/])(?=[A-Za-z])"));
    return keptTogether(QStyledItemDelegate::displayText(value, locale).replace(joints, QStringLiteral("\\1\u200b")));
  }
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    constexpr int padding = 6;  // of the style sheet
    QStyleOptionViewItem narrower = option;
    narrower.rect.setWidth(std::max(1, option.rect.width() - 2 * padding));
    QSize size = QStyledItemDelegate::sizeHint(narrower, index);
    size.rheight() += padding;  // lines of one row stand closer than those of two
    return size;
  }
};

}  // namespace

void wrapCells(QTableView* table) {
  table->setWordWrap(true);
  table->setItemDelegate(new WrappedCells(table));
  if (auto* quiet = dynamic_cast<QuietTable*>(table)) quiet->forgetWidths();
  table->verticalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
}

QTableView* makeSentenceTable(QAbstractItemModel* model, const QString& accessible_name, const QString& empty_text) {
  QTableView* table = makeTable(model, accessible_name, empty_text);
  wrapCells(table);
  table->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);  // a sentence may be higher than the table
  table->horizontalHeader()->setSectionResizeMode(model->columnCount() - 1, QHeaderView::Stretch);
  return table;
}

Segments::Segments(const QStringList& texts, const QString& accessible_name, QWidget* parent) : QWidget(parent) {
  setAccessibleName(accessible_name);
  auto* line = new QHBoxLayout(this);
  line->setContentsMargins(0, 0, 0, 0);
  line->setSpacing(0);
  auto* group = new QButtonGroup(this);
  group->setExclusive(true);
  for (qsizetype i = 0; i < texts.size(); ++i) {
    auto* button = new QPushButton(texts[i]);
    button->setCheckable(true);
    button->setChecked(i == 0);
    button->setProperty("segment", i == 0                  ? QStringLiteral("first")
                                   : i + 1 == texts.size() ? QStringLiteral("last")
                                                           : QStringLiteral("middle"));
    button->setAccessibleName(accessible_name + QStringLiteral(": ") + texts[i]);
    group->addButton(button, static_cast<int>(i));
    line->addWidget(button);
    buttons_.push_back(button);
  }
  line->addStretch();
  setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
  connect(group, &QButtonGroup::idClicked, this, [this](int index) {
    if (index == current_) return;
    current_ = index;
    Q_EMIT chosen(index);
  });
}

void Segments::setCurrent(int index) {
  current_ = index;
  buttons_[static_cast<std::size_t>(index)]->setChecked(true);
}

namespace {

/// Two areas side by side, and below one another where the width is not enough for both: a page beside the help, or on
/// a small screen, gets longer instead of being cut.
class ReflowingSplitter : public QSplitter {
 public:
  ReflowingSplitter(QWidget* parent, QList<int> parts) : QSplitter(Qt::Horizontal, parent), parts_(std::move(parts)) {}
  [[nodiscard]] QSize minimumSizeHint() const override {
    const QSize least = QSplitter::minimumSizeHint();
    return {std::min(least.width(), widthBelow()), least.height()};
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QSplitter::resizeEvent(event);
    reflow();
  }
  bool event(QEvent* event) override {
    const bool handled = QSplitter::event(event);
    if (event->type() == QEvent::LayoutRequest) reflow();
    return handled;
  }

 private:
  [[nodiscard]] int leastWidth(int i) const {
    const QWidget* area = widget(i);
    if (area->isHidden()) return 0;
    return std::max(area->minimumWidth(), area->minimumSizeHint().width());
  }
  /// What the areas need below one another.
  [[nodiscard]] int widthBelow() const {
    int width = 0;
    for (int i = 0; i < count(); ++i) width = std::max(width, leastWidth(i));
    return width;
  }
  [[nodiscard]] int widthBeside() const {
    int width = 0;
    for (int i = 0; i < count(); ++i) {
      if (leastWidth(i) > 0) width += leastWidth(i) + (width > 0 ? handleWidth() : 0);
    }
    return width;
  }
  void reflow() {
    const Qt::Orientation wanted = width() < widthBeside() ? Qt::Vertical : Qt::Horizontal;
    if (wanted == orientation()) return;
    setOrientation(wanted);
    setSizes(parts_);
  }

  QList<int> parts_;
};

}  // namespace

QSplitter* makeSplitter(QWidget* parent, QWidget* first, QWidget* second, int first_part, int second_part,
                        Qt::Orientation orientation) {
  const QList<int> parts{first_part * 100, second_part * 100};
  auto* splitter =
      orientation == Qt::Horizontal ? new ReflowingSplitter(parent, parts) : new QSplitter(orientation, parent);
  splitter->setChildrenCollapsible(false);
  splitter->setHandleWidth(12);
  splitter->addWidget(first);
  splitter->addWidget(second);
  splitter->setStretchFactor(0, first_part);
  splitter->setStretchFactor(1, second_part);
  splitter->setSizes(parts);
  return splitter;
}

namespace {

/// Tabs as high as their place, whatever the texts of all their pages would need at this width: Qt lays out every page
/// to find that out, hidden ones too, several times for each change.
class Tabs : public QTabWidget {
 public:
  using QTabWidget::QTabWidget;
  [[nodiscard]] bool hasHeightForWidth() const override { return false; }
  /// As high as the page that is shown needs to be; the others wait until it is their turn.
  [[nodiscard]] QSize minimumSizeHint() const override {
    const QSize all = QTabWidget::minimumSizeHint();
    if (currentWidget() == nullptr) return all;
    int highest = 0;
    for (int i = 0; i < count(); ++i) highest = std::max(highest, leastHeight(*widget(i)));
    return {all.width(), all.height() - highest + leastHeight(*currentWidget())};
  }

 protected:
  /// What its page needs has changed: Qt's tabs keep that to themselves.
  bool event(QEvent* event) override {
    const bool handled = QTabWidget::event(event);
    if (event->type() == QEvent::LayoutRequest) updateGeometry();
    if (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize) fitTitles();
    return handled;
  }

 private:
  /// Titles stand closer where all of them have no room otherwise.
  void fitTitles() {
    constexpr int saved = 22;  // of the style sheet, a tab
    const bool narrow = tabBar()->property("narrow").toBool();
    int wide = 0;
    for (int i = 0; i < count(); ++i) {
      if (isTabVisible(i)) wide += tabBar()->tabRect(i).width() + (narrow ? saved : 0);
    }
    if (narrow == (wide > width())) return;
    tabBar()->setProperty("narrow", !narrow);
    style()->unpolish(tabBar());
    style()->polish(tabBar());
    QEvent styled(QEvent::StyleChange);  // else it keeps the widths that it has
    QCoreApplication::sendEvent(tabBar(), &styled);
  }
  static int leastHeight(const QWidget& page) {
    const int asked = page.minimumHeight() > 0 ? page.minimumHeight() : page.minimumSizeHint().height();
    return std::max(0, asked);
  }
};

}  // namespace

QTabWidget* makeTabs(QWidget* parent) {
  auto* tabs = new Tabs(parent);
  QObject::connect(tabs, &QTabWidget::currentChanged, tabs, [tabs] { tabs->updateGeometry(); });
  tabs->setDocumentMode(true);
  tabs->tabBar()->setDrawBase(false);
  tabs->tabBar()->setExpanding(false);
  return tabs;
}

void drawEmptyText(QPainter& painter, const QRect& area, const QString& title, const QString& how) {
  constexpr int flags = Qt::AlignHCenter | Qt::TextWordWrap;
  constexpr int between = 8;
  const QRect inner = area.adjusted(24, 16, -24, -16);
  painter.setFont(textFont(sizes::font_body, QFont::DemiBold));
  const int title_height = painter.fontMetrics().boundingRect(inner, flags, title).height();
  const int how_height = QFontMetrics(textFont(sizes::font_body)).boundingRect(inner, flags, how).height();
  const int top = inner.top() + (inner.height() - title_height - between - how_height) / 2;
  painter.setPen(theme().text);
  painter.drawText(QRect(inner.left(), top, inner.width(), title_height), flags, title);
  painter.setFont(textFont(sizes::font_body));
  painter.setPen(theme().text_secondary);
  painter.drawText(QRect(inner.left(), top + title_height + between, inner.width(), how_height + 4), flags, how);
}

QFrame* makeLine(Qt::Orientation orientation) {
  auto* line = new QFrame;
  line->setProperty("role", QStringLiteral("line"));
  if (orientation == Qt::Horizontal) {
    line->setFixedHeight(1);
  } else {
    line->setFixedWidth(1);
  }
  return line;
}

}  // namespace spindrift::gui
