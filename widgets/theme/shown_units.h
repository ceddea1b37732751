// SPDX-License-Identifier: GPL-3.0-or-later
// The units on screen: one place decides, whatever shows a quantity asks it.
//
// Values, and texts while they are put together, have the units of files (mm, um, urad, degC, K). They are converted
// where they become visible: a cell and a title of a table, a tile, a sentence, a number on an axis, what stands under
// the cursor. So files, exports, clipboard of programs and the command line never know of the choice, and whatever is
// stored is read in the units of today.
#pragma once

#include <QObject>
#include <QString>

namespace spindrift::gui {

/// What the user wants to read. All false: the units of files, um and urad written as µm and µrad.
struct UnitChoice {
  bool inches = false;      ///< lengths in inches, errors in micro-inches (1 in = 25.4 mm by definition)
  bool arcseconds = false;  ///< angles that files give in urad
  bool fahrenheit = false;  ///< temperatures, and differences of them
  [[nodiscard]] bool operator==(const UnitChoice&) const = default;
};

/// From any thread.
[[nodiscard]] UnitChoice shownUnits();
/// GUI thread. Tells whoever listens to UnitsNotifier, if anything is another.
void setShownUnits(const UnitChoice& choice);

class UnitsNotifier : public QObject {
  Q_OBJECT
 public:
  static UnitsNotifier& instance();

 Q_SIGNALS:
  void changed();
};

/// While it lives everything is drawn in the units of files: for export and print. Nobody is told, so that no event
/// loop may run meanwhile.
class FileUnits {
 public:
  FileUnits();
  ~FileUnits();
  FileUnits(const FileUnits&) = delete;
  FileUnits& operator=(const FileUnits&) = delete;

 private:
  UnitChoice before_;
};

/// shown = factor * value + offset.
struct ShownUnit {
  QString name;         ///< as people write it: "µin", "µin/°F"
  double factor = 1.0;  ///< 1: as in the file
  double offset = 0.0;  ///< of a temperature alone; a difference and an uncertainty have none
  [[nodiscard]] bool converted() const { return factor != 1.0; }
  [[nodiscard]] double shown(double value) const { return factor * value + offset; }
  [[nodiscard]] double stored(double shown_value) const { return (shown_value - offset) / factor; }
  /// Digits behind the point that tell no less than `decimals` of the unit of the file.
  [[nodiscard]] int decimals(int decimals) const;
};

/// Of a unit as in a file or as people write it ("um", "µrad/K", "um/(m K)", "°C"). In inches a metre below the line
/// becomes an inch where micrometres stand above it: 1 µm/m = 1 µin/in. Other units stay.
[[nodiscard]] ShownUnit shownUnit(const QString& unit);

/// A title with its unit behind the last " / " in the units on screen: "EX / µm" -> "EX / µin".
[[nodiscard]] QString shownTitle(const QString& title);
/// The unit of such a title; converted() is false where it has none that would be converted.
[[nodiscard]] ShownUnit unitOfTitle(const QString& title);

/// The unit as it stands in the title; empty: it has none.
[[nodiscard]] QString fileUnitOfTitle(const QString& title);

/// A finished text with its quantities in the units on screen: "12.4 ± 0.3 µm", "0.6 to 1.2 K", "(1.0, 2.5) mm". A
/// quantity whose numbers cannot be told with certainty keeps numbers and unit, as does one that is converted already.
[[nodiscard]] QString onScreen(const QString& text);
/// A cell of a table whose column has `unit` (of files; may be empty): its numbers are of that unit, unless the cell
/// names one itself. Numbers among words keep the unit and name it, so that nobody reads them in the unit of the title.
[[nodiscard]] QString cellOnScreen(const QString& text, const QString& unit);
/// Nothing but numbers: "12.4 ± 0.3", "1.2, 3.4".
[[nodiscard]] bool isNumbers(const QString& text);

}  // namespace spindrift::gui
