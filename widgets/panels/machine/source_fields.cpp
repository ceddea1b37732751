// SPDX-License-Identifier: GPL-3.0-or-later
#include "widgets/panels/machine/source_fields.h"

#include <QCoreApplication>

namespace spindrift::gui {

std::vector<FormField> fieldsOfSource(const std::string& kind) {
  using Kind = FormField::Kind;
  const auto tr = [](const char* text) {
    return QCoreApplication::translate("spindrift::gui::ConnectionsPanel", text);
  };
  std::vector<FormField> fields{{"name", tr("Name"), {}, Kind::Text}, {"url", tr("Address"), {}, Kind::Text}};
  const auto add = [&](const char* key, const QString& label, const QString& hint, Kind what) {
    fields.push_back({key, label, hint, what});
  };
  if (kind == "mqtt") {
    add("user", tr("User"), {}, Kind::Text);
    add("password_env", tr("Variable with the password"), tr("name of a variable of the environment"), Kind::Text);
    add("password_file", tr("File with the password"), tr("readable by its owner only"), Kind::Text);
    add("ca_file", tr("Certificates"), tr("file with those that are trusted"), Kind::Text);
    add("client_id", tr("Name of this client"), tr("with one, nothing is missed while it is away"), Kind::Text);
  } else if (kind == "modbus") {
    add("unit_id", tr("Unit"), tr("1"), Kind::Number);
    add("interval_s", tr("Read every / s"), tr("1"), Kind::Number);
  } else if (kind == "mtconnect") {
    add("interval_s", tr("Stream every / s"), {}, Kind::Number);
  } else if (kind == "linuxcnc") {
    add("interval_s", tr("Read every / s"), tr("1"), Kind::Number);
    add("password_env", tr("Variable with the password"), tr("of linuxcncrsh; name of a variable of the environment"),
        Kind::Text);
    add("password_file", tr("File with the password"), tr("readable by its owner only"), Kind::Text);
  } else if (kind == "genicam") {
    add("exposure_us", tr("Exposure / µs"), tr("as the camera has it"), Kind::Number);
    add("gain", tr("Gain"), tr("in the unit of the camera, mostly dB"), Kind::Number);
    add("trigger", tr("Trigger"), tr("none; Software, Line1 …"), Kind::Text);
    add("region", tr("Region"), tr("x, y, width, height in pixels"), Kind::Numbers);
  } else {
    add("line", tr("Pattern of a line"), tr("T1={column} T2={bed}"), Kind::Text);
    add("save", tr("Append every line to"), tr("file, for printed touches"), Kind::Text);
  }
  if (kind == "modbus" || kind == "text") {
    add("baud", tr("Baud"), tr("9600"), Kind::Number);
    add("parity", tr("Parity"), tr("none, even or odd"), Kind::Text);
  }
  return fields;
}

}  // namespace spindrift::gui
