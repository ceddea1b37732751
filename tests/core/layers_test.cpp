// SPDX-License-Identifier: GPL-3.0-or-later
// The layers of DESIGN.md as a test: every #include of the tree is read and held against them.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/atomic_file.h"
#include "tests/support/source_folder.h"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

/// A folder of core may include itself and what stands here.
const std::map<std::string, std::set<std::string>>& allowedIncludes() {
  static const std::map<std::string, std::set<std::string>> table = [] {
    const std::set<std::string> instruments{"imaging", "probing", "scanning", "thermal"};
    std::map<std::string, std::set<std::string>> t;
    t["base"] = {};
    t["math"] = {"base"};
    t["geometry"] = {"base", "math"};
    t["machine"] = {"base", "math", "geometry"};
    for (const auto& name : instruments) t[name] = {"base", "math", "geometry", "machine"};
    std::set<std::string> below = {"base", "math", "geometry", "machine"};
    below.insert(instruments.begin(), instruments.end());
    t["finite_elements"] = {"base", "math", "geometry", "machine"};
    below.insert("finite_elements");
    t["simulator"] = {"base", "math", "geometry", "machine", "finite_elements"};
    below.insert("simulator");
    t["simulation"] = below;
    t["discrepancy"] = below;  // and never simulation: a search tested on its own formulas proves nothing
    below.insert({"simulation", "discrepancy"});
    t["connect"] = {"base", "math", "geometry", "machine", "imaging", "probing"};
    below.insert("connect");
    t["control"] = {"base", "math", "geometry", "machine", "imaging", "probing", "connect"};
    below.insert("control");
    t["session"] = below;
    below.insert("session");
    t["reporting"] = below;
    below.insert("reporting");
    t["workflows"] = below;
    below.insert("workflows");
    t["tasks"] = below;
    below.insert("tasks");
    t["plant"] = below;
    return t;
  }();
  return table;
}

/// The same for the folders of widgets.
const std::map<std::string, std::set<std::string>>& allowedIncludesOfWidgets() {
  static const std::map<std::string, std::set<std::string>> table = [] {
    std::map<std::string, std::set<std::string>> t;
    t["theme"] = {};
    t["view3d"] = {"theme"};
    t["common"] = {"theme"};
    t["report"] = {"theme"};
    t["image_view"] = {"theme", "common"};
    t["plots"] = {"theme", "common", "view3d"};
    t["export"] = {"theme", "common", "image_view", "plots", "report", "view3d"};
    t["models"] = {"theme", "common"};
    t["recording"] = {};
    t["commands"] = {"models"};
    t["workflow"] = {"theme", "common", "models"};
    t["jobs"] = {"theme", "common", "models"};
    t["services"] = {"theme", "common", "models", "jobs", "image_view"};
    std::set<std::string> below = {"theme",  "view3d", "common",   "report",   "image_view", "plots",
                                   "export", "models", "commands", "workflow", "jobs",       "services"};
    t["panels"] = below;
    below.insert("panels");
    t["teaching"] = below;
    t["pages"] = below;
    below.insert({"teaching", "pages", "recording"});
    t["shell"] = below;
    return t;
  }();
  return table;
}

std::vector<fs::path> sources(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".h" || extension == ".cpp" || extension == ".c") files.push_back(entry.path());
  }
  return files;
}

std::vector<std::string> includesOf(const fs::path& file) {
  static const std::regex include(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re", std::regex::multiline);
  const std::string text = readFile(file);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

bool isWindowSystem(const std::string& include) {
  static const std::regex pattern(R"(^(Q[A-Z][A-Za-z]*|Qt[A-Za-z]+/.*|vtk.*|qcustomplot\.h|GL/.*|EGL/.*)$)");
  return std::regex_match(include, pattern);
}

TEST(Layers, CoreFoldersIncludeOnlyWhatIsBelowThem) {
  const fs::path root = spindrift::testing::sourceFolder();
  std::size_t checked = 0;
  std::vector<std::string> wrong;
  for (const auto& entry : fs::directory_iterator(root / "core")) {
    if (!entry.is_directory()) continue;
    const std::string folder = entry.path().filename().string();
    ASSERT_TRUE(allowedIncludes().contains(folder)) << "core/" << folder << " has no place among the layers";
    for (const fs::path& file : sources(entry.path())) {
      for (const std::string& include : includesOf(file)) {
        if (include.starts_with("widgets/") || include.starts_with("app/") || include.starts_with("tests/")) {
          wrong.push_back(file.string() + " includes " + include);
        }
        if (!include.starts_with("core/")) continue;
        const std::string other = include.substr(5, include.find('/', 5) - 5);
        if (other != folder && !allowedIncludes().at(folder).contains(other)) {
          wrong.push_back(file.string() + " includes " + include);
        }
        ++checked;
      }
    }
  }
  EXPECT_THAT(wrong, ::testing::IsEmpty());
  EXPECT_GT(checked, 30U);
}

/// Files of a folder in which a pattern stands.
std::vector<std::string> holding(const fs::path& folder, const std::regex& pattern) {
  std::vector<std::string> found;
  for (const fs::path& file : sources(folder))
    if (std::regex_search(readFile(file), pattern)) found.push_back(file.string());
  return found;
}

TEST(Layers, TheWindowShowsNumbersAndWorksNoneOut) {
  std::vector<std::string> wrong;
  for (const fs::path& file : sources(spindrift::testing::sourceFolder() / "widgets"))
    for (const std::string& include : includesOf(file))
      if (include.starts_with("core/math/")) wrong.push_back(file.string() + " includes " + include);
  EXPECT_THAT(wrong, ::testing::IsEmpty()) << "statistics and fits belong into the result that is stored";
  const std::regex work(
      R"re(\b(evaluateField|fieldBetween|secondAxisBias|closedFormsBeside|contrastGain|contrastAt|fitNineParameters|compareWithOthers|chooseTableOrder|leastSquares|solveLinear|differencesFromReference|gapFigures|verifyFigures|leaveOutPoles)\(|[.>]predict\(|\bDeviationQuery\b)re");
  EXPECT_THAT(holding(spindrift::testing::sourceFolder() / "widgets", work), ::testing::IsEmpty())
      << "maps, closed forms and predictions are made by a job, in core";
}

/// What takes as long as there are points, states or nodes is asked of core in a work that is handed to a job or to a
/// LatestWork, never by the window itself.
TEST(Layers, TablesAndPicturesAreWorkedOutBesideTheWindow) {
  const std::regex call(
      R"re(\b(effectShape|pointChanges|verifyFiguresOfPoints|verifyMap|residualMap)\(|->movements\()re");
  const std::regex handed_over(R"re(\b(display|run|ask)\()re");
  std::size_t found = 0;
  for (const fs::path& file : sources(spindrift::testing::sourceFolder() / "widgets")) {
    if (file.extension() != ".cpp") continue;
    const std::string text = readFile(file);
    for (std::sregex_iterator it(text.begin(), text.end(), call), end; it != end; ++it, ++found) {
      // Within the function that calls, from its beginning on.
      const auto at = static_cast<std::size_t>(it->position());
      const std::size_t begin = text.rfind("\n}\n", at);
      const std::string before = text.substr(begin == std::string::npos ? 0 : begin, at - begin);
      EXPECT_TRUE(std::regex_search(before, handed_over)) << file << ": " << it->str();
    }
  }
  EXPECT_GT(found, 4U);
}

/// Two types of one name in one namespace share the destructor that the linker finds first, and free what they never
/// had. No compiler tells.
TEST(Layers, NoTwoTypesHaveOneName) {
  static const std::regex opens(R"re(^namespace ([\w:]+)? ?\{)re");
  static const std::regex type(R"re(^(?:struct|class) (\w+)(?: final)?(?: ?\{| : ))re");
  std::map<std::string, std::set<std::string>> defined;
  for (const char* folder : {"core", "widgets", "app"}) {
    for (const fs::path& file : sources(spindrift::testing::sourceFolder() / folder)) {
      std::vector<std::string> around;
      std::istringstream lines(readFile(file));
      for (std::string line; std::getline(lines, line);) {
        std::smatch found;
        if (std::regex_search(line, found, opens)) {
          around.push_back(found[1]);
        } else if (line.starts_with("}  // namespace") && !around.empty()) {
          around.pop_back();
        } else if (std::regex_search(line, found, type) &&
                   std::find(around.begin(), around.end(), "") == around.end()) {
          std::string name;
          for (const std::string& space : around) name += space + "::";
          defined[name + std::string(found[1])].insert(file.string());
        }
      }
    }
  }
  EXPECT_GT(defined.size(), 500U);
  for (const auto& [name, files] : defined)
    EXPECT_EQ(files.size(), 1U) << name << " in " << ::testing::PrintToString(files);
}

/// What may be shown of a task, and for how long, is told by the graph: nobody compares what results were made from.
TEST(Layers, FreshnessIsAskedOfTheGraphAlone) {
  const std::regex compared(R"re(provenance\.(inputs|options|inputs_fingerprint) *[!=]=|\binputsKey\(\) *[!=]=)re");
  EXPECT_THAT(holding(spindrift::testing::sourceFolder() / "widgets", compared), ::testing::IsEmpty());
}

TEST(Layers, ConstIsConstInTheWindow) {
  EXPECT_THAT(holding(spindrift::testing::sourceFolder() / "widgets", std::regex("const_cast<")), ::testing::IsEmpty());
}

/// What differs from task to task stands in its declaration (core/tasks/task_kinds.cpp): who asks what a task is called
/// to find out what to do holds a second one.
TEST(Layers, NobodyBranchesOnTheNameOfATask) {
  const fs::path root = spindrift::testing::sourceFolder();
  const std::string declared = readFile(root / "core/tasks/task_kinds.cpp");
  static const std::regex id(R"re(\.id = "([a-z-]+)")re");
  std::set<std::string> ids;
  for (std::sregex_iterator it(declared.begin(), declared.end(), id), end; it != end; ++it) ids.insert((*it)[1]);
  ASSERT_GT(ids.size(), 8U);
  std::string any;
  for (const std::string& one : ids) any += (any.empty() ? "" : "|") + one;
  const std::string word = R"re("()re" + any + R"re()")re";
  const std::regex branch("[=!]= *" + word + "|" + word + " *[=!]=|QLatin1String\\(" + word +
                          "\\) *[=!]=|case hash\\(" + word);
  std::vector<std::string> wrong;
  for (const char* folder : {"core/tasks", "app/cli", "widgets/commands", "widgets/jobs", "widgets/models",
                             "widgets/pages", "widgets/panels", "widgets/services", "widgets/workflow"})
    for (std::string& file : holding(root / folder, branch)) wrong.push_back(std::move(file));
  EXPECT_THAT(wrong, ::testing::IsEmpty());
}

/// Warnings and notes are sentences of their own, on every page, in the list of steps and in reports: nobody behind has
/// to give them a capital. (The sentence of an error follows the name of its file.)
TEST(Layers, WarningsAreSentencesFromTheirBeginning) {
  const std::regex small_letter(
      R"re((warnings|notes)\.(push_back|emplace_back)\(\s*(std::string\()?\s*(fmt::format\(\s*)?"[a-z]+[^a-z.])re");
  EXPECT_THAT(holding(spindrift::testing::sourceFolder() / "core", small_letter), ::testing::IsEmpty());
}

TEST(Layers, ErrorsCarryLinesOfFilesAsNumbers) {
  const std::regex line_in_words(R"re(\{[^{};]*,\s*(fmt::format\()?"line [0-9{])re");
  const std::regex first_line(R"re(fail\(file, "line )re");
  for (const std::regex& pattern : {line_in_words, first_line})
    EXPECT_THAT(holding(spindrift::testing::sourceFolder() / "core", pattern), ::testing::IsEmpty())
        << "SourcePlace::atLine";
}

TEST(Layers, CoreAndCommandLineKnowNoQtAndNoVtk) {
  const fs::path root = spindrift::testing::sourceFolder();
  std::vector<std::string> wrong;
  for (const char* folder : {"core", "app/cli"}) {
    for (const fs::path& file : sources(root / folder)) {
      for (const std::string& include : includesOf(file)) {
        if (isWindowSystem(include)) wrong.push_back(file.string() + " includes " + include);
      }
    }
  }
  EXPECT_THAT(wrong, ::testing::IsEmpty());
}

TEST(Layers, CommandLineIncludesCoreOnly) {
  for (const fs::path& file : sources(spindrift::testing::sourceFolder() / "app/cli")) {
    for (const std::string& include : includesOf(file)) {
      EXPECT_FALSE(include.starts_with("widgets/") || include.starts_with("app/gui/"))
          << file << " includes " << include;
    }
  }
}

TEST(Layers, WidgetsDoNotIncludeTheProgram) {
  for (const fs::path& file : sources(spindrift::testing::sourceFolder() / "widgets")) {
    for (const std::string& include : includesOf(file)) EXPECT_FALSE(include.starts_with("app/")) << file;
  }
}

/// Pages are put together from panels, panels from views; services show nothing. None of these knows a page.
TEST(Layers, FoldersOfWidgetsIncludeOnlyWhatIsBelowThem) {
  const std::map<std::string, std::set<std::string>>& allowed = allowedIncludesOfWidgets();
  const fs::path root = spindrift::testing::sourceFolder() / "widgets";
  std::size_t checked = 0;
  std::vector<std::string> wrong;
  for (const fs::path& file : sources(root)) {
    const std::string folder = fs::relative(file, root).begin()->string();
    ASSERT_TRUE(allowed.contains(folder)) << "widgets/" << folder << " has no place among the layers";
    for (const std::string& include : includesOf(file)) {
      if (!include.starts_with("widgets/")) continue;
      const std::string other = include.substr(8, include.find('/', 8) - 8);
      if (other != folder && !allowed.at(folder).contains(other))
        wrong.push_back(file.string() + " includes " + include);
      ++checked;
    }
  }
  EXPECT_THAT(wrong, ::testing::IsEmpty());
  EXPECT_GT(checked, 30U);
}

/// What several areas show stands in widgets/panels/common.
TEST(Layers, PanelsKnowOnlyPanelsOfTheirArea) {
  const fs::path root = spindrift::testing::sourceFolder() / "widgets/panels";
  std::vector<std::string> wrong;
  for (const fs::path& file : sources(root)) {
    const std::string area = fs::relative(file, root).begin()->string();
    for (const std::string& include : includesOf(file)) {
      if (!include.starts_with("widgets/panels/") || include == "widgets/panels/page_context.h") continue;
      const std::string other = include.substr(15, include.find('/', 15) - 15);
      if (other != area && other != "common") wrong.push_back(file.string() + " includes " + include);
    }
  }
  EXPECT_THAT(wrong, ::testing::IsEmpty());
}

TEST(Layers, HeavyHeadersStayInFewFiles) {
  for (const fs::path& file : sources(spindrift::testing::sourceFolder() / "core")) {
    if (file.extension() != ".h") continue;
    for (const std::string& include : includesOf(file)) {
      EXPECT_FALSE(include.starts_with("pcl/") || include.starts_with("ceres/") || include.starts_with("soci") ||
                   include.starts_with("curl/") || include.starts_with("pugixml") || include.starts_with("mosquitto") ||
                   include.starts_with("modbus") || include.starts_with("poppler") || include.starts_with("arv") ||
                   include.ends_with(".pb.h"))
          << file << " includes " << include << " in a header";
    }
  }
}

TEST(Layers, EverySourceNamesItsLicence) {
  const fs::path root = spindrift::testing::sourceFolder();
  for (const char* folder : {"core", "app", "widgets", "tests"}) {
    for (const fs::path& file : sources(root / folder)) {
      const std::string text = readFile(file);
      const std::string wanted = std::string(folder) == "core" ? "SPDX-License-Identifier: Apache-2.0"
                                                               : "SPDX-License-Identifier: GPL-3.0-or-later";
      EXPECT_NE(text.substr(0, 120).find(wanted), std::string::npos) << file << " lacks " << wanted;
    }
  }
}

/// The list of that name in a CMakeLists.txt, one path of core a line.
std::set<std::string> listOf(const std::string& cmake, const std::string& name) {
  const std::size_t begin = cmake.find("set(" + name + "\n");
  if (begin == std::string::npos) return {};
  const std::string text = cmake.substr(begin, cmake.find(')', begin) - begin);
  static const std::regex path(R"(\w+/\w+\.cpp)");
  std::set<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), path), end; it != end; ++it) found.insert("core/" + it->str());
  return found;
}

// The program that feeds the readers takes the sources it needs out of core one by one; only a build of an hour would
// tell of one that is missing.
TEST(Layers, ReadersUnderMutatedFilesHaveTheSourcesOfWhatTheyInclude) {
  const fs::path root = spindrift::testing::sourceFolder(), fuzz = root / "tests/fuzz";
  const std::string cmake = readFile(fuzz / "CMakeLists.txt");
  const std::set<std::string> listed = listOf(cmake, "sources"), declared_only = listOf(cmake, "declared_only");
  ASSERT_GT(listed.size(), 40U);
  std::vector<std::string> todo(listed.begin(), listed.end());
  for (const fs::path& file : sources(fuzz))
    if (file.filename() != "whole_core_readers.cpp") todo.push_back("tests/fuzz/" + file.filename().string());
  std::set<std::string> seen(todo.begin(), todo.end()), missing, wanted;
  while (!todo.empty()) {
    const std::string file = todo.back();
    todo.pop_back();
    ASSERT_TRUE(fs::exists(root / file)) << "tests/fuzz/CMakeLists.txt names " << file << ", which is not there";
    for (const std::string& include : includesOf(root / file)) {
      if (!include.starts_with("core/") || include.starts_with("core/base/") || !include.ends_with(".h")) continue;
      const std::string source = include.substr(0, include.size() - 2) + ".cpp";
      if (fs::exists(root / source) && !listed.contains(source)) {
        wanted.insert(source);
        if (!declared_only.contains(source)) missing.insert(source + ", wanted by " + file);
      }
      if (fs::exists(root / include) && seen.insert(include).second) todo.push_back(include);
    }
  }
  EXPECT_THAT(missing, ::testing::IsEmpty()) << "in tests/fuzz/CMakeLists.txt";
  EXPECT_EQ(wanted, declared_only);
}

TEST(Layers, IncludePatternRecognisesWindowSystems) {
  EXPECT_TRUE(isWindowSystem("QWidget"));
  EXPECT_TRUE(isWindowSystem("QtWidgets/QWidget"));
  EXPECT_TRUE(isWindowSystem("vtkActor.h"));
  EXPECT_FALSE(isWindowSystem("Eigen/QR"));
  EXPECT_FALSE(isWindowSystem("core/base/error.h"));
}

}  // namespace
}  // namespace spindrift
