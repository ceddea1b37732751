// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that are typed into: what all editors of a description share.
#pragma once

#include <QString>
#include <QStringList>
#include <nlohmann/json.hpp>
#include <optional>

class QTableWidget;

namespace spindrift::gui {

[[nodiscard]] QTableWidget* makeEditor(const QStringList& headers, const QString& accessible_name);
[[nodiscard]] QString numberText(const std::optional<double>& value);
[[nodiscard]] QString textAt(const QTableWidget* table, int row, int column);
void setText(QTableWidget* table, int row, int column, const QString& text);
/// A number, or the text itself so that the reader can say what is wrong with it.
[[nodiscard]] nlohmann::json numberOrText(const QString& text);

}  // namespace spindrift::gui
