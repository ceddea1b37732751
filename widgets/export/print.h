// SPDX-License-Identifier: GPL-3.0-or-later
// Printing: a picture of a page, and the pages of a report.
#pragma once

#include <QImage>
#include <QString>

class QPrinter;

namespace spindrift::gui {

class ReportPages;

/// The picture as large as the page allows, its sides in proportion, `heading` above it. Throws InputError if the
/// printer cannot begin.
void printPicture(QPrinter& printer, const QImage& picture, const QString& heading);
/// Every page of a report that is opened and shown nowhere else; of a range chosen in the dialog only those. Waits for
/// each page with the window alive. Throws InputError as above.
void printReport(QPrinter& printer, ReportPages& pages, int dpi = 200);

}  // namespace spindrift::gui
