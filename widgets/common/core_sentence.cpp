// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/common/core_sentence.h"

#include <QCache>
#include <QCoreApplication>
#include <QMutex>
#include <QRegularExpression>
#include <algorithm>
#include <array>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "widgets/common/core_formats.h"
#include "widgets/common/languages.h"
#include "widgets/common/words.h"
#include "widgets/theme/numbers.h"

namespace spindrift::gui {
namespace {

constexpr int deepest_sentence = 8;  ///< sentences in sentences
constexpr qsizetype longest = 6000;  ///< characters; what is longer is a document
constexpr qsizetype most_known = 4000;
constexpr qsizetype shortest_key = 3;
constexpr qsizetype telling = 12;        ///< letters of a format that nothing else is likely to have
constexpr qsizetype longest_list = 300;  ///< characters of "this, that and more"

/// A format of {fmt}, cut at its placeholders.
struct Format {
  QStringList pieces;          ///< one more than there are placeholders
  std::vector<QString> holes;  ///< "", ":.2f", "0"
  [[nodiscard]] qsizetype letters() const {
    qsizetype sum = 0;
    for (const QString& piece : pieces) sum += piece.size();
    return sum;
  }
};

Format cut(const QString& text) {
  Format format;
  QString piece;
  for (qsizetype i = 0; i < text.size(); ++i) {
    const QChar c = text[i];
    const bool doubled = i + 1 < text.size() && text[i + 1] == c;
    if (c == QLatin1Char('%') && i + 1 < text.size() && text[i + 1] == QLatin1Char('1')) {
      format.pieces << piece;  // a title with the name of its axis
      piece.clear();
      format.holes.emplace_back();
      ++i;
    } else if ((c == QLatin1Char('{') || c == QLatin1Char('}')) && doubled) {
      piece += c;
      ++i;
    } else if (c == QLatin1Char('{')) {
      // "{:.{}f}" has a placeholder within: what it stands for is a number of digits and is not to be seen.
      qsizetype end = i + 1;
      for (int depth = 1; end < text.size(); ++end) {
        if (text[end] == QLatin1Char('{')) ++depth;
        if (text[end] == QLatin1Char('}') && --depth == 0) break;
      }
      format.pieces << piece;
      piece.clear();
      format.holes.push_back(text.mid(i + 1, end - i - 1));
      i = end;
    } else {
      piece += c;
    }
  }
  format.pieces << piece;
  return format;
}

/// A placeholder that only a number can fill.
bool isNumber(const QString& hole) {
  return hole.contains(QLatin1Char(':')) && !hole.isEmpty() && QStringLiteral("fegd").contains(hole.back());
}

QRegularExpression patternOf(const Format& format) {
  QString pattern = QStringLiteral("\\A");
  std::vector<int> group(format.holes.size(), 0);
  for (qsizetype i = 0; i < format.pieces.size(); ++i) {
    pattern += QRegularExpression::escape(format.pieces[i]);
    if (i == format.pieces.size() - 1) break;
    const QString& hole = format.holes[static_cast<std::size_t>(i)];
    pattern += isNumber(hole) ? QStringLiteral(
                                    "([-+\u2212]?(?:(?:[0-9.]+ \u00d7 )?10\u207b?[\u00b9\u00b2\u00b3\u2070-\u2079]+|"
                                    "[0-9.]+(?:e[-+]?[0-9]+)?|nan|inf)|\u2013)")
                              : QStringLiteral("(.*?)");
  }
  return QRegularExpression(pattern + QStringLiteral("\\z"), QRegularExpression::DotMatchesEverythingOption);
}

struct Entry {
  QString key;  ///< the longest piece: a sentence without it was not made from this format
  qsizetype letters = 0;
  QRegularExpression pattern;
  Format english;
  Format translation;
};

/// Which value of the English format stands at place `i` of the translation: "{}" in turn, "{2}" the third.
std::size_t valueAt(const Format& translation, std::size_t i) {
  bool numbered = false;
  const int index = translation.holes[i].section(QLatin1Char(':'), 0, 0).toInt(&numbered);
  return numbered ? static_cast<std::size_t>(index) : i;
}

class Catalogue {
 public:
  Catalogue() {
    for (const char* format : coreFormats()) {
      // Blanks at the ends are those of the sentence around it.
      const QString english = QString::fromUtf8(format).trimmed();
      const QString translated = QCoreApplication::translate("core", format).trimmed();
      if (translated == english) continue;
      Entry entry{{}, 0, {}, cut(english), cut(translated)};
      entry.letters = entry.english.letters();
      if (entry.english.holes.empty()) {
        whole_.emplace(english, translated);
        continue;
      }
      entry.key = *std::max_element(entry.english.pieces.begin(), entry.english.pieces.end(),
                                    [](const QString& a, const QString& b) { return a.size() < b.size(); });
      if (entry.key.size() < shortest_key) continue;
      entries_.push_back(std::move(entry));
    }
    // The format that says most of the sentence is the one it was made from.
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.letters > b.letters; });
  }

  QString sentence(const QString& english) {
    if (english.size() > longest) return english;
    if (const QString* known = known_.object(english)) return *known;
    tried_.clear();
    const QString text = rendered(english, 0).text;
    known_.insert(english, new QString(text));
    return text;
  }

 private:
  /// A translation and how many letters of the English text were found in formats: 0 if nothing is known of it.
  struct Rendered {
    QString text;
    qsizetype known = 0;
  };

  Rendered rendered(const QString& english, int depth) {
    if (english.isEmpty() || depth > deepest_sentence) return {shownNumbers(english), 0};
    // The parts of a long sentence come up again and again.
    if (const auto seen = tried_.find(english); seen != tried_.end() && seen->second.depth <= depth)
      return seen->second.rendered;
    Rendered best = whole(english, depth);
    const auto consider = [&best](Rendered&& other) {
      if (other.known > best.known) best = std::move(other);
    };
    if (best.known < english.size()) {
      if (const QString trimmed = english.trimmed(); trimmed != english) {
        Rendered inner = rendered(trimmed, depth + 1);
        const qsizetype start = english.indexOf(trimmed);
        inner.text = english.left(start) + inner.text + english.mid(start + trimmed.size());
        consider(std::move(inner));
      } else {
        consider(otherwiseWritten(english, depth));
        consider(titleWithUnit(english, depth));
        consider(inParts(english, depth));
      }
    }
    if (best.known == 0) best.text = shownNumbers(english);
    tried_.insert_or_assign(english, Tried{best, depth});
    return best;
  }

  /// Made from one format.
  Rendered whole(const QString& english, int depth) {
    if (const auto found = whole_.find(english); found != whole_.end()) return {found->second, english.size()};
    Rendered best;
    for (Entry& entry : entries_) {
      // What costs least comes first: most formats begin with words that few sentences begin with.
      if (entry.letters > english.size() || !english.startsWith(entry.english.pieces.front()) ||
          !english.endsWith(entry.english.pieces.back()) || !english.contains(entry.key))
        continue;
      if (entry.pattern.pattern().isEmpty()) entry.pattern = patternOf(entry.english);
      const QRegularExpressionMatch match = entry.pattern.match(english);
      if (!match.hasMatch()) continue;
      Rendered made{entry.translation.pieces.front(), entry.letters};
      bool sensible = true;
      for (std::size_t i = 0; i < entry.translation.holes.size(); ++i) {
        const QString value = match.captured(static_cast<int>(valueAt(entry.translation, i)) + 1);
        const Rendered filled = rendered(value, depth + 1);
        // "{} of {}" is in many a sentence that was not made from it.
        sensible =
            sensible && (entry.letters >= telling || filled.known > 0 || !value.trimmed().contains(QLatin1Char(' ')));
        made.known += filled.known;
        made.text += filled.text + entry.translation.pieces[static_cast<qsizetype>(i) + 1];
      }
      if (!sensible) continue;
      if (made.known > best.known) best = std::move(made);
    }
    return best;
  }

  /// With a full stop that the format lacks, or with a capital at its start.
  Rendered otherwiseWritten(const QString& english, int depth) {
    if (english.endsWith(QLatin1Char('.')) && !english.endsWith(QStringLiteral("..")) && english.size() > 1) {
      Rendered text = whole(english.chopped(1), depth);
      text.text += QLatin1Char('.');
      if (text.known > 0) return text;
    }
    if (!english.front().isUpper()) return {};
    Rendered text = whole(english.front().toLower() + english.mid(1), depth);
    if (text.known > 0) text.text = sentenceStart(text.text);
    return text;
  }

  /// "gain / (µm/(m² K))".
  Rendered titleWithUnit(const QString& english, int depth) {
    static const QString border = QStringLiteral(" / ");
    const qsizetype at = english.lastIndexOf(border);
    if (at <= 0 || english.size() > longest_list) return {};
    Rendered title = rendered(english.left(at), depth + 1);
    title.text += english.mid(at);
    return title;
  }

  /// Several sentences in a row, "file, line 12: sentence", "one; other", "this, that".
  Rendered inParts(const QString& english, int depth) {
    static const std::array<QString, 4> borders = {QStringLiteral(". "), QStringLiteral(": "), QStringLiteral("; "),
                                                   QStringLiteral(", ")};
    Rendered best;
    for (const QString& border : borders) {
      const bool comma = border.front() == QLatin1Char(',');
      if (comma && (english.size() > longest_list || best.known > 0)) continue;
      for (qsizetype at = english.indexOf(border); at >= 0; at = english.indexOf(border, at + 1)) {
        const qsizetype end = border.front() == QLatin1Char('.') ? at + 1 : at;
        const Rendered first = rendered(english.left(end), depth + 2);
        const Rendered rest = rendered(english.mid(at + border.size()), depth + 1);
        const QString between = border.front() == QLatin1Char('.') ? QStringLiteral(" ") : border;
        Rendered joined{first.text + between + rest.text, first.known + rest.known};
        // "; and so on" may be a format of its own.
        if (const auto tail = whole_.find(english.mid(end)); tail != whole_.end() && end < english.size())
          joined = {first.text + tail->second, first.known + tail->first.size()};
        if (joined.known > best.known) best = std::move(joined);
      }
    }
    if (best.known == 0 && english.size() <= longest_list) best = joinedNames(english, depth);
    return best;
  }

  /// "EX, EY and EZ": a list of names and values, whose word before the last is translated. Two words of a text in a
  /// row are no name.
  Rendered joinedNames(const QString& english, int depth) {
    static const QRegularExpression words(QStringLiteral("[a-z]{3,} [a-z]{3,}"));
    for (const auto& word : {QStringLiteral("and"), QStringLiteral("or")}) {
      const QString joint = QLatin1Char(' ') + word + QLatin1Char(' ');
      const qsizetype at = english.lastIndexOf(joint);
      const auto translated = whole_.find(word);
      if (at < 0 || translated == whole_.end()) continue;
      const QString left = english.left(at);
      const QString right = english.mid(at + joint.size());
      const Rendered first = rendered(left, depth + 1);
      const Rendered last = rendered(right, depth + 1);
      if ((first.known == 0 && words.match(left).hasMatch()) || (last.known == 0 && words.match(right).hasMatch()))
        continue;
      return {first.text + QLatin1Char(' ') + translated->second + QLatin1Char(' ') + last.text,
              first.known + word.size() + last.known};
    }
    return {};
  }

  struct Hash {
    std::size_t operator()(const QString& text) const { return qHash(text); }
  };
  /// What is found deep within other sentences may have stopped short: it does not hold further up.
  struct Tried {
    Rendered rendered;
    int depth = 0;
  };
  std::unordered_map<QString, Tried, Hash> tried_;    ///< of the sentence at work
  std::unordered_map<QString, QString, Hash> whole_;  ///< formats without placeholders
  std::vector<Entry> entries_;
  QCache<QString, QString> known_{most_known};
};

}  // namespace

QString coreSentence(const QString& english) {
  static const QString without_catalogue = QStringLiteral("en");
  if (currentLanguage() == without_catalogue) return english;
  // Jobs make sentences in their threads.
  static QMutex mutex;
  static QString language;
  static std::unique_ptr<Catalogue> catalogue;
  const QMutexLocker lock(&mutex);
  if (!catalogue || language != currentLanguage()) {
    language = currentLanguage();
    catalogue = std::make_unique<Catalogue>();
  }
  return catalogue->sentence(english);
}

QString coreSentence(std::string_view english) {
  return coreSentence(QString::fromUtf8(english.data(), static_cast<qsizetype>(english.size())));
}

QString coreSentence(const char* english) {
  return coreSentence(QString::fromUtf8(english));
}

}  // namespace spindrift::gui
