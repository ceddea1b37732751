// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/program_simulator.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <set>
#include <system_error>

#include "core/base/atomic_file.h"
#include "core/base/csv.h"
#include "core/base/sha256.h"
#include "core/base/text.h"
#include "core/finite_elements/fe_deviation.h"
#include "core/machine/simulation_table.h"
#include "core/simulator/answer_cache.h"
#include "core/simulator/answer_store.h"
#include "core/simulator/child_program.h"
#include "core/simulator/deck_template.h"
#include "core/simulator/log_tables.h"
#include "core/simulator/run_folder.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

constexpr const char* log_name = "simulator.log";
constexpr std::size_t most_quoted = 160;

struct Answer {
  std::vector<SimulationRow> rows;
  SimulationTable table;
  double elapsed_s = 0.0;
};

std::shared_ptr<const Answer> answerOf(ProgramAnswer answer, const fs::path& file, double elapsed_s) {
  SimulationTable table(answer.rows, answer.by_place, file);
  return std::make_shared<const Answer>(Answer{std::move(answer.rows), std::move(table), elapsed_s});
}

/// What a program said, for the middle of a sentence: blanks and line ends as one blank, its own sentences parted by
/// semicolons, without a full stop at the end, not too long.
std::string oneLine(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!blank) {
      out += c;
    } else if (!out.empty() && out.back() != ' ') {
      out += ' ';
    }
    if (out.size() > most_quoted) break;
  }
  for (std::size_t i = 0; i + 2 < out.size(); ++i) {
    const bool begins = out[i + 2] == '*' || std::isupper(static_cast<unsigned char>(out[i + 2])) != 0;
    if (out[i] == '.' && out[i + 1] == ' ' && begins) out[i] = ';';
  }
  if (out.size() > most_quoted) {
    std::size_t end = most_quoted - 3;
    while (end > 0 && (static_cast<unsigned char>(out[end]) & 0xC0U) == 0x80U) --end;
    out = out.substr(0, end) + "...";
  }
  while (!out.empty() && (out.back() == '.' || out.back() == ' ')) out.pop_back();
  return out;
}

/// The last line that says something.
std::string lastLine(const std::string& text) {
  const std::string_view content = trimmed(text);
  const std::size_t before = content.rfind('\n');
  return oneLine(before == std::string_view::npos ? content : content.substr(before + 1));
}

/// What CalculiX says from its first *ERROR on; empty: there is none.
std::string errorOf(const std::string& printed) {
  const std::size_t at = printed.find("*ERROR");
  return at == std::string::npos ? "" : oneLine(std::string_view(printed).substr(at, 4 * most_quoted));
}

/// An InputError about a file of a run, without the folder that is gone when the user reads it.
std::string withoutFolder(const InputError& error, const std::string& name) {
  std::string text = error.sentence();
  while (!text.empty() && text.back() == '.') text.pop_back();
  const std::string place = error.where().words();
  return place.empty() ? fmt::format("{} {}", name, text) : fmt::format("{}, {}: {}", name, place, text);
}

std::string part(std::string_view text) {
  return fmt::format("{}:{};", text.size(), text);
}

/// A program as it stands on this machine: another version is another simulator.
std::string identityOf(const std::string& program) {
  std::vector<std::string> folders;
  if (program.find('/') == std::string::npos) {
    if (const char* path = std::getenv("PATH"); path != nullptr) folders = splitList(path, ':');
  }
  for (const std::string& folder : folders) {
    std::error_code error;
    const fs::path file = fs::canonical(fs::path(folder) / program, error);
    if (error || !fs::is_regular_file(file, error)) continue;
    const auto size = fs::file_size(file, error);
    const auto written = fs::last_write_time(file, error).time_since_epoch().count();
    return fmt::format("{} {} {}", file.string(), size, written);
  }
  return program;
}

/// Lines that begin with the keyword.
std::size_t countOfCards(const std::string& text, std::string_view keyword) {
  std::size_t count = 0;
  for (const std::string& line : splitList(text, '\n')) {
    std::string name = line.substr(0, line.find(','));
    name = std::string(trimmed(name));
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
    if (name == keyword) ++count;
  }
  return count;
}

struct Template {
  std::string relative;  ///< "heat.inp.in"
  std::string output;    ///< "heat.inp"
  DeckTemplate deck;
};

std::vector<std::vector<std::string>> commandsAt(const JsonNode& node) {
  std::vector<std::vector<std::string>> out;
  for (const JsonNode& item : node.items()) {
    std::vector<std::string> command;
    for (const JsonNode& word : item.items()) {
      if (command.empty()) {
        command.push_back(word.name());
        if (command.front().find('/') != std::string::npos) (void)pathWithin(word);
      } else {
        command.push_back(word.string());
      }
      if (command.back().find('\0') != std::string::npos) word.reject("a text without a zero");
    }
    if (command.empty()) item.reject("a program and its arguments");
    out.push_back(std::move(command));
  }
  if (out.empty()) node.reject("at least one command, [\"program\", \"argument\", ..]");
  return out;
}

}  // namespace

struct ProgramSimulator::Parts {
  explicit Parts(const SimulatorFile& simulator_file) : file(simulator_file) {}

  SimulatorFile file;
  bool calculix = false;
  std::vector<Template> templates;
  std::vector<std::string> includes;
  std::string observe;  ///< calculix
  std::vector<std::vector<std::string>> commands;
  std::string result;
  double time_limit_s = 600.0;
  FeMap map;               ///< calculix
  std::size_t states = 0;  ///< expected; 0: not known
  LogTables tables;
  TableTimes times;
  AnswerStore store;

  mutable AnswerCache<Answer> answers{256};
  mutable std::mutex mutex;
  struct Content {
    fs::file_time_type written;
    std::uintmax_t size = 0;
    std::string digest;
  };
  mutable std::map<std::string, Content> contents;   ///< of files that go in as they are
  mutable std::optional<std::size_t> rows_expected;  ///< of an answer

  void readFiles(const std::vector<std::string>& parameters);
  void readCalculix();
  void readTables(const std::optional<OperatingLog>& log);
  [[nodiscard]] std::size_t statesOfDeck() const;

  /// Everything that decides the answer.
  [[nodiscard]] std::string keyOf(const std::vector<std::string>& filled) const;
  [[nodiscard]] std::string digestOf(const std::string& relative) const;
  [[nodiscard]] std::shared_ptr<const Answer> made(const std::string& key, const std::vector<std::string>& filled,
                                                   const ParameterValues& given, const JobContext& job) const;
  void prepare(const RunFolder& folder, const std::vector<std::string>& filled) const;
  /// Empty, or why it failed.
  [[nodiscard]] std::string runCommand(const std::vector<std::string>& command, const RunFolder& folder,
                                       double& elapsed_s, const JobContext& job) const;
  /// Throws InputError with places in the folder.
  [[nodiscard]] ProgramAnswer readResult(const RunFolder& folder) const;
  /// Empty, or what is wrong with the number of rows.
  [[nodiscard]] std::string wrongCount(const ProgramAnswer& answer) const;
};

void ProgramSimulator::Parts::readFiles(const std::vector<std::string>& parameters) {
  const JsonNode& root = file.root;
  std::set<std::string> used{log_name};
  const auto take = [&](const JsonNode& node, const std::string& name) {
    if (!used.insert(name).second) {
      node.reject(fmt::format("a file that does not stand as {} in the folder of a run beside another one", name));
    }
  };
  const JsonNode list = root.at("templates");
  for (const JsonNode& item : list.items()) {
    const std::string relative = file.relativeFile(item);
    const fs::path path(relative);
    if (!path.has_extension()) item.reject("a name with an ending, which the filled file does not have");
    std::string output = fs::path(path).replace_extension().generic_string();
    take(item, output);
    templates.push_back(
        {relative, std::move(output),
         DeckTemplate(readFile(file.folder() / path), file.folder() / path, parameters, tables.names())});
  }
  if (templates.empty()) list.reject("at least one template, which takes the parameters");
  if (const auto include = root.find("include")) {
    for (const JsonNode& item : include->items()) {
      includes.push_back(file.relativeFile(item));
      take(item, includes.back());
    }
  }
  commands = commandsAt(root.at("run"));
  if (const auto limit = root.find("time_limit_s")) time_limit_s = limit->positiveNumber();
  const JsonNode output = root.at(calculix ? "displacements" : "result");
  result = pathWithin(output);
  take(output, result);
}

std::size_t ProgramSimulator::Parts::statesOfDeck() const {
  const std::string stem = fs::path(result).stem().string();
  const JsonNode list = file.root.at("templates");
  std::string relative;
  for (const JsonNode& item : list.items()) {
    relative = file.relativeFile(item);
    if (fs::path(relative).replace_extension().stem().string() == stem) break;
  }
  return countOfCards(readFile(file.folder() / relative), "*STATIC");
}

void ProgramSimulator::Parts::readCalculix() {
  const JsonNode& root = file.root;
  const std::string ending = fs::path(result).extension().string();
  if (ending != ".dat" && ending != ".frd") {
    root.at("displacements").reject("a .dat (or .frd) of CalculiX");
  }
  observe = file.relativeFile(root.at("observe"));
  map.observe = file.folder() / observe;
  map.unit_of_displacement = root.at("unit_of_displacement").oneOf({"mm", "m"});
  if (const auto first = root.find("first_state_s")) map.first_state_s = first->number();
  map.first_state_s = map.first_state_s.value_or(0.0);
  map.state_interval_s = root.at("state_interval_s").positiveNumber();
  const CsvTable table = CsvTable::read(map.observe);
  const std::size_t component = table.column("component");
  const std::size_t dof = table.column("dof");
  const std::size_t point = table.column("point");
  const std::size_t node = table.column("node");
  const std::size_t weight = table.column("weight");
  if (table.rowCount() == 0) throw InputError({map.observe, ""}, "holds no row; allowed: at least one.");
  for (std::size_t i = 0; i < table.rowCount(); ++i) {
    if (!componentFromString(table.text(i, component))) {
      throw InputError(table.place(i, component), fmt::format("component \"{}\" is not known; allowed: EX, EY, EZ, EA, "
                                                              "EB or EC.",
                                                              table.text(i, component)));
    }
    const double direction = table.number(i, dof);
    if (direction != 1.0 && direction != 2.0 && direction != 3.0) {
      throw InputError(table.place(i, dof), fmt::format("dof {} is not allowed; allowed: 1, 2 or 3.", direction));
    }
    (void)table.requiredText(i, point);
    (void)table.number(i, node);
    (void)table.number(i, weight);
  }
}

void ProgramSimulator::Parts::readTables(const std::optional<OperatingLog>& log) {
  const JsonNode& root = file.root;
  if (tables.empty()) return;
  times.first_s = root.numberOr("first_state_s", 0.0);
  times.increment_s = root.at("increment_s").positiveNumber();
  if (states > 0) {
    times.end_s = static_cast<double>(states) * *map.state_interval_s;
  } else if (log && !log->empty()) {
    times.end_s = log->time_s().back() - times.first_s;
  } else {
    root.at("tables").reject("tables in a campaign with a log.csv, which tells how long they are");
  }
  if (times.end_s < 0.0 || times.end_s / times.increment_s > 1e6) {
    root.at("increment_s").reject(fmt::format("an increment of which at most a million are in {:.6g} s", times.end_s));
  }
}

ProgramSimulator::ProgramSimulator(const SimulatorFile& file, const std::optional<OperatingLog>& log)
    : parts_(std::make_unique<Parts>(file)) {
  SPINDRIFT_ASSERT(file.kind == SimulatorKind::Command || file.kind == SimulatorKind::Calculix, "a program");
  file_ = file.file;
  parameters_ = file.parameters;
  Parts& parts = *parts_;
  parts.calculix = file.kind == SimulatorKind::Calculix;
  if (const auto tables = file.root.find("tables")) parts.tables = LogTables(*tables, log, file.parameters);
  std::vector<std::string> names;
  for (const SimulatorParameter& p : file.parameters) names.push_back(p.name);
  parts.readFiles(names);
  if (parts.calculix) {
    parts.readCalculix();
    parts.states = parts.statesOfDeck();
  }
  parts.readTables(log);
  windows_ = parts.tables.windows();
  std::vector<SimulatorParameter> sensors = parts.tables.sensors();
  if (const auto given = file.root.find("sensor_values")) {
    for (const auto& [name, node] : given->members()) {
      const auto found =
          std::find_if(sensors.begin(), sensors.end(), [&n = name](const auto& p) { return p.name == n; });
      if (found == sensors.end()) node.reject("a value of a sensor of the tables, such as \"sensor.T_room_degC.gain\"");
      found->value = node.number();
      if (found->value < found->min || found->value > found->max) {
        node.reject(fmt::format("a number from {} to {}", exactNumber(found->min), exactNumber(found->max)));
      }
    }
  }
  parameters_.insert(parameters_.end(), sensors.begin(), sensors.end());
  try {
    (void)parts.tables.text(parts.times, completeValues(*this, {}));
  } catch (const SimulatorFailed& failure) {
    throw InputError({file.file, "$.tables"}, failure.what());
  }
}

ProgramSimulator::~ProgramSimulator() = default;

std::string ProgramSimulator::Parts::digestOf(const std::string& relative) const {
  const fs::path path = file.folder() / relative;
  std::error_code error;
  const auto written = fs::last_write_time(path, error);
  const std::uintmax_t size = error ? 0 : fs::file_size(path, error);
  const std::scoped_lock lock(mutex);
  Content& content = contents[relative];
  if (error || content.digest.empty() || content.written != written || content.size != size) {
    content = {written, size, sha256OfFile(path)};
  }
  return content.digest;
}

std::string ProgramSimulator::Parts::keyOf(const std::vector<std::string>& filled) const {
  std::string text = part("spindrift-simulator-run 1");
  for (std::size_t i = 0; i < templates.size(); ++i) text += part(templates[i].output) + part(filled[i]);
  for (const std::string& include : includes) text += part(include) + part(digestOf(include));
  for (const auto& command : commands) {
    text += part(identityOf(command.front()));
    for (const std::string& word : command) text += part(word);
    text += '\n';
  }
  text += part(result);
  if (calculix) {
    text += part(digestOf(observe)) + part(map.unit_of_displacement) + part(exactNumber(*map.first_state_s)) +
            part(exactNumber(*map.state_interval_s));
  }
  return sha256(text);
}

void ProgramSimulator::Parts::prepare(const RunFolder& folder, const std::vector<std::string>& filled) const {
  for (std::size_t i = 0; i < templates.size(); ++i)
    writeFileAtomically(folder.path() / templates[i].output, filled[i]);
  for (const std::string& include : includes) copyWithin(file.folder(), folder.path(), include);
  std::error_code ignored;
  fs::create_directories((folder.path() / result).parent_path(), ignored);
}

std::string ProgramSimulator::Parts::runCommand(const std::vector<std::string>& command, const RunFolder& folder,
                                                double& elapsed_s, const JobContext& job) const {
  const fs::path log = folder.path() / log_name;
  std::ofstream(log, std::ios::app) << "$ " << fmt::format("{}", fmt::join(command, " ")) << '\n';
  std::error_code ignored;
  const std::uintmax_t before = fs::file_size(log, ignored);
  const ChildEnd end = runProgram({command, folder.path(), log, time_limit_s, {{"OMP_NUM_THREADS", "1"}}}, job);
  elapsed_s += end.elapsed_s;
  std::string printed = readFile(log);
  printed.erase(0, std::min<std::size_t>(printed.size(), before));
  const std::string error = calculix ? errorOf(printed) : "";
  const std::string said = !error.empty() ? error : lastLine(printed);
  const std::string quoted = said.empty() ? " and printed nothing" : fmt::format(" and said \"{}\"", said);
  switch (end.how) {
    case ChildEnd::How::NotStarted:
      return fmt::format("cannot be started ({}; it has to be a program of PATH, or ./name of an included file)",
                         std::strerror(end.code));
    case ChildEnd::How::TimeOut:
      return fmt::format("was not done after {:.6g} s (\"time_limit_s\"){}", time_limit_s, quoted);
    case ChildEnd::How::TooMuchOutput:
      return "printed without an end";
    case ChildEnd::How::Signalled:
      return fmt::format("was ended by signal {}{}", end.code, quoted);
    case ChildEnd::How::Exited:
      break;
  }
  if (end.code != 0) return fmt::format("ended with status {}{}", end.code, quoted);
  if (!error.empty()) return fmt::format("said \"{}\"", error);
  return "";
}

ProgramAnswer ProgramSimulator::Parts::readResult(const RunFolder& folder) const {
  const fs::path path = folder.path() / result;
  if (!calculix) {
    (void)SimulationTable::read(path);  // checks it
    return readAnswer(readFile(path), path);
  }
  FeMap run = map;
  run.result = path;
  JobContext quiet;
  FeDeviation deviation = feDeviation(run, openFeResult, quiet);
  if (states > 0 && deviation.states != states) {
    throw InputError({path, ""}, fmt::format("holds {} states; allowed: {}, one for each *STATIC of the template.",
                                             deviation.states, states));
  }
  ProgramAnswer answer;
  answer.rows = std::move(deviation.rows);
  std::stable_sort(answer.rows.begin(), answer.rows.end(),
                   [](const SimulationRow& a, const SimulationRow& b) { return a.point < b.point; });
  return answer;
}

std::string ProgramSimulator::Parts::wrongCount(const ProgramAnswer& answer) const {
  const std::scoped_lock lock(mutex);
  if (!rows_expected) rows_expected = answer.rows.size();
  if (*rows_expected == answer.rows.size()) return "";
  return fmt::format("gave {} predictions where it gave {} with other values", answer.rows.size(), *rows_expected);
}

std::shared_ptr<const Answer> ProgramSimulator::Parts::made(const std::string& key,
                                                            const std::vector<std::string>& filled,
                                                            const ParameterValues& given, const JobContext& job) const {
  if (std::optional<ProgramAnswer> kept = store.load(key); kept && wrongCount(*kept).empty()) {
    return answerOf(std::move(*kept), file.file, 0.0);
  }
  RunFolder folder;
  const auto fail = [&](const std::vector<std::string>& command, const std::string& reason) {
    std::set<std::string> kept{log_name};
    for (const Template& t : templates) kept.insert(t.output);
    folder.keep(kept);
    throw SimulatorFailed(fmt::format("\"{}\" {}, run with {}; log and input are kept in {}.", fmt::join(command, " "),
                                      reason, valuesText(given), folder.path().string()));
  };
  double elapsed_s = 0.0;
  std::string reason;
  try {
    prepare(folder, filled);
  } catch (const InputError& error) {
    throw SimulatorFailed(error.what());
  }
  for (const auto& command : commands) {
    reason = runCommand(command, folder, elapsed_s, job);
    if (!reason.empty()) fail(command, reason);
  }
  const std::vector<std::string>& last = commands.back();
  std::error_code ignored;
  if (!fs::is_regular_file(folder.path() / result, ignored)) {
    const std::string said = lastLine(readFile(folder.path() / log_name));
    fail(last, fmt::format("left no {} (the log ends with \"{}\")", result, said));
  }
  ProgramAnswer answer;
  try {
    answer = readResult(folder);
  } catch (const InputError& error) {
    reason = fmt::format("left a result that cannot be used ({})", withoutFolder(error, result));
  }
  if (reason.empty()) reason = wrongCount(answer);
  if (!reason.empty()) fail(last, reason);
  store.save(key, answer);
  return answerOf(std::move(answer), file.file, elapsed_s);
}

SimulatorRun ProgramSimulator::run(const ParameterValues& values, const ObservationSet& at,
                                   const JobContext& job) const {
  const ParameterValues all = completeValues(*this, values);
  const Parts& parts = *parts_;
  const std::map<std::string, std::string> tables = parts.tables.text(parts.times, all);
  std::vector<std::string> filled;
  for (const Template& t : parts.templates) filled.push_back(t.deck.filled(all, tables));
  const std::string key = parts.keyOf(filled);
  const auto kept = parts.answers.get(key, job, [&] { return parts.made(key, filled, values, job); });
  SimulatorRun out;
  out.rows = kept.answer->rows;
  out.predicted = matchSimulation(kept.answer->table, at, {}, file_.filename().string()).predicted;
  out.elapsed_s = kept.fresh ? kept.answer->elapsed_s : 0.0;
  return out;
}

void ProgramSimulator::writeVersion(const ParameterValues& values, const fs::path& folder,
                                    const nlohmann::json& change) const {
  const Parts& parts = *parts_;
  const ParameterValues all = completeValues(*this, values);
  std::vector<JsonEdit> edits = valueEdits(parts.file, all);
  for (const SimulatorParameter& p : parameters_) {
    if (p.of_sensor && all.at(p.name) != p.value) edits.push_back({{"sensor_values", p.name}, all.at(p.name)});
  }
  const std::string text = appendedJson(editedJson(parts.file.text, edits), "history", change);
  writeWholeFolder(folder, [&](const fs::path& into) {
    writeFileAtomically(into / "simulator.json", text);
    for (const Template& t : parts.templates) copyWithin(parts.file.folder(), into, t.relative);
    for (const std::string& include : parts.includes) copyWithin(parts.file.folder(), into, include);
    if (!parts.observe.empty() &&
        std::find(parts.includes.begin(), parts.includes.end(), parts.observe) == parts.includes.end()) {
      copyWithin(parts.file.folder(), into, parts.observe);
    }
  });
}

}  // namespace spindrift
