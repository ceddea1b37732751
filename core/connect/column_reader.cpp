// SPDX-License-Identifier: Apache-2.0
#include "core/connect/column_reader.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/untrusted_text.h"
#include "core/connect/unit_conversion.h"

namespace spindrift {

ColumnReader::ColumnReader(const Connections& connections, std::function<void(const std::string&)> tell)
    : columns_(connections.columns),
      tell_(std::move(tell)),
      column_of_(connections.sources.size()),
      states_(connections.columns.size()) {
  for (const SourceDescription& source : connections.sources) sources_.push_back(source.name);
  for (std::uint32_t c = 0; c < columns_.size(); ++c) column_of_[columns_[c].source].push_back(c);
  for (std::uint32_t s = 0; s < sources_.size(); ++s) setUnits(s, std::vector<std::string>(column_of_[s].size()));
}

void ColumnReader::setUnits(std::uint32_t source, const std::vector<std::string>& units) {
  for (std::size_t i = 0; i < column_of_[source].size() && i < units.size(); ++i) {
    const std::uint32_t c = column_of_[source][i];
    const ColumnMapping& mapping = columns_[c];
    const std::string unit = mapping.unit.empty() ? units[i] : mapping.unit;
    const auto conversion = conversionInto(mapping.column, unit);
    State& state = states_[c];
    if (!conversion) {
      if (state.usable) {
        tell_(fmt::format("{} {} is in {}, which cannot become {}: column {} stays empty.", sources_[source],
                          mapping.address, unit, unitOfColumn(mapping.column), mapping.column));
      }
      state.usable = false;
      continue;
    }
    state.usable = true;
    state.scale = conversion->scale * mapping.scale;
    state.offset = conversion->offset * mapping.scale + mapping.offset;
    state.conversion = unit.empty() ? "as the source gives it" : unit;
    if (state.scale != 1.0 || state.offset != 0.0)
      state.conversion += fmt::format(": {:.10g} x + {:.10g}", state.scale, state.offset);
  }
}

std::optional<ColumnReader::Reading> ColumnReader::read(std::uint32_t source, const Record& record) {
  if (source >= column_of_.size() || record.item >= column_of_[source].size()) return std::nullopt;
  Reading reading;
  reading.column = column_of_[source][record.item];
  const ColumnMapping& mapping = columns_[reading.column];
  const State& state = states_[reading.column];
  if (record.quality == Quality::Good) {
    reading.value = state.scale * record.value + state.offset;
  } else if (record.quality == Quality::Text) {
    const auto word = mapping.values.find(record.text);
    if (word != mapping.values.end()) {
      reading.value = word->second;
    } else if (mapping.otherwise) {
      reading.value = *mapping.otherwise;
    }
  }
  if (!state.usable || (!std::isfinite(reading.value) && record.quality != Quality::Unavailable)) {
    reading.value = std::numeric_limits<double>::quiet_NaN();
    reading.refused = true;
    complain(source, mapping, record);
  }
  return reading;
}

void ColumnReader::complain(std::uint32_t source, const ColumnMapping& mapping, const Record& record) {
  State& state = states_[column_of_[source][record.item]];
  if (state.word_told || !state.usable) return;
  state.word_told = true;
  tell_(record.quality == Quality::Text
            ? fmt::format("{} {} says \"{}\", which is neither a number nor among \"values\" of column {}.",
                          sources_[source], mapping.address, printable(beginning(record.text, 80)), mapping.column)
            : fmt::format("{} {} gives a number that is not finite; column {} is empty there.", sources_[source],
                          mapping.address, mapping.column));
}

}  // namespace spindrift
