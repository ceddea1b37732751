// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that are typed into: what all editors of a description share.
#pragma once

#include <QString>
#include <QStringList>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

class QPushButton;
class QTableWidget;
class QWidget;

namespace spindrift::gui {

/// Why a button does nothing, beside it.
void sayBeside(QWidget* button, const QString& sentence);
/// The button removes the row that is chosen, and `removed` is called; where none is chosen it says so.
void makeRemoving(QPushButton* button, QTableWidget* table, std::function<void()> removed);
/// `empty_text` stands in it while it has no rows.
[[nodiscard]] QTableWidget* makeEditor(const QStringList& headers, const QString& accessible_name,
                                       const QString& empty_text = {});
[[nodiscard]] QString numberText(const std::optional<double>& value);
[[nodiscard]] QString textAt(const QTableWidget* table, int row, int column);
void setText(QTableWidget* table, int row, int column, const QString& text);
/// A number, or the text itself so that the reader can say what is wrong with it.
[[nodiscard]] nlohmann::json numberOrText(const QString& text);

}  // namespace spindrift::gui
