// SPDX-License-Identifier: GPL-3.0-or-later
// What cpack writes: the same bytes twice, everything a desktop asks for, dependencies that hold, programs that run
// from an empty root.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <set>

#include "tests/package/shell.h"
#include "tests/support/source_folder.h"
#include "tests/support/temp_folder.h"

namespace spindrift::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::MatchesRegex;

/// Packed once for all tests of this file; the programs are unpacked into an empty root.
class Package : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    pack("first", "umask 022; export TZ=UTC LC_ALL=C.UTF-8;");
    // An empty root whose dpkg knows what is installed here, so that it holds the dependencies against it.
    (void)outputOf(fmt::format(
        "mkdir -p {0}/var/lib/dpkg/{{info,updates,triggers}} && cp /var/lib/dpkg/status {0}/var/lib/dpkg && "
        "sed -i '/^Package: spindrift\\(-dev\\)\\?$/,/^$/d' {0}/var/lib/dpkg/status && cp -r /var/lib/dpkg/arch* "
        "{0}/var/lib/dpkg; "
        "$([ $(id -u) = 0 ] || echo fakeroot) dpkg --root={0} --log=/dev/null --force-not-root,unsafe-io -i {1} {2} "
        "2>{0}.log || "
        "{{ grep -v 'files list file' {0}.log; false; }}",
        root(), deb("first", "spindrift"), deb("first", "spindrift-dev")));
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static void pack(const std::string& name, const std::string& before) {
    // Compressing takes most of the time and changes nothing of what is asked here.
    (void)outputOf(fmt::format(
        "unset SOURCE_DATE_EPOCH; {} cd {} && {} --config {}/CPackConfig.cmake -D CPACK_DEBIAN_COMPRESSION_TYPE=none "
        "-B {}",
        before, folder_->path().string(), SPINDRIFT_CPACK, SPINDRIFT_BUILD_DIR, (*folder_ / name).string()));
  }
  /// The file of one package.
  static std::string deb(const std::string& of, const std::string& package) {
    return (*folder_ / of).string() + "/" + package + "_0*.deb";
  }
  static std::string root() { return (*folder_ / "root").string(); }
  static std::string field(const std::string& package, const std::string& name) {
    return outputOf(fmt::format("dpkg-deb -f {} {}", deb("first", package), name));
  }

  static std::unique_ptr<TempFolder> folder_;
};
std::unique_ptr<TempFolder> Package::folder_;

// Later, elsewhere and in another language; still the bytes of the last commit.
TEST_F(Package, IsTheSameTwice) {
  pack("second", "umask 022; export TZ=Pacific/Auckland LC_ALL=de_DE.UTF-8;");
  for (const std::string package : {"spindrift", "spindrift-dev"}) {
    const auto sum = [&](const std::string& of) {
      return outputOf(fmt::format("sha256sum {} | cut -d' ' -f1", deb(of, package)));
    };
    EXPECT_THAT(sum("first"), MatchesRegex("[0-9a-f]+\n"));
    EXPECT_EQ(sum("first"), sum("second")) << package;
    const std::string dates = outputOf(
        fmt::format("dpkg-deb --fsys-tarfile {} | TZ=UTC tar -t -v --full-time | awk '{{print $4, $5, $2}}' | sort -u",
                    deb("first", package)));
    EXPECT_EQ(linesIn(dates).size(), 1u) << dates;  // one moment, one owner
    EXPECT_THAT(dates, HasSubstr("root/root"));
    const ShellOutcome commit = shell(fmt::format(
        "TZ=UTC git -C {} log -1 --date=format-local:'%Y-%m-%d %H:%M:%S' --format=%cd", sourceFolder().string()));
    if (commit.status == 0) {
      EXPECT_THAT(dates, HasSubstr(commit.output.substr(0, commit.output.size() - 1)));
    }
  }
}

TEST_F(Package, IsNotPackedWithFoldersThatAreClosedToOthers) {
  const ShellOutcome outcome =
      shell(fmt::format("umask 077; cd {} && {} --config {}/CPackConfig.cmake -B {}", folder_->path().string(),
                        SPINDRIFT_CPACK, SPINDRIFT_BUILD_DIR, (*folder_ / "closed").string()));
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.output, HasSubstr("allowed: 022"));
}

TEST_F(Package, HoldsWhatADesktopAsksFor) {
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root()))
    if (entry.is_regular_file()) files.insert(entry.path().string().substr(root().size() + 1));
  std::vector<std::string> wanted = {"usr/share/applications/spindrift.desktop",
                                     "usr/share/mime/packages/spindrift.xml",
                                     "usr/share/metainfo/org.example.spindrift.metainfo.xml",
                                     "usr/share/icons/hicolor/scalable/apps/spindrift.svg",
                                     "usr/share/spindrift/scenarios/fiducials.json",
                                     "usr/share/doc/spindrift/manual.html",
                                     "usr/share/doc/spindrift/manual.pdf",
                                     "usr/share/doc/spindrift/manual-de.html",
                                     "usr/share/doc/spindrift/manual-de.pdf",
                                     "usr/include/spindrift/compensator.h"};
  for (const int size : {16, 22, 24, 32, 48, 64, 128, 256, 512})
    wanted.push_back(fmt::format("usr/share/icons/hicolor/{0}x{0}/apps/spindrift.png", size));
  for (const std::string program : {"spindrift", "spindrift-cli", "spindrift-fe"}) {
    wanted.push_back("usr/bin/" + program);
    wanted.push_back("usr/share/man/man1/" + program + ".1.gz");
    wanted.push_back("usr/share/bash-completion/completions/" + program);
  }
  for (const std::string package : {"spindrift", "spindrift-dev"}) {
    wanted.push_back("usr/share/doc/" + package + "/copyright");
    wanted.push_back("usr/share/doc/" + package + "/changelog.gz");
  }
  EXPECT_THAT(files, IsSupersetOf(wanted));
  for (const int size : {16, 512}) {
    EXPECT_THAT(outputOf(fmt::format("file {0}/usr/share/icons/hicolor/{1}x{1}/apps/spindrift.png", root(), size)),
                HasSubstr(fmt::format("PNG image data, {0} x {0}", size)));
  }
}

TEST_F(Package, DescribesItselfAsTheDesktopWants) {
  (void)outputOf(fmt::format("desktop-file-validate --warn-kde {}/usr/share/applications/spindrift.desktop", root()));
  (void)outputOf(fmt::format("appstreamcli validate --no-net {}/usr/share/metainfo/*.xml", root()));
  (void)outputOf(fmt::format("update-mime-database {}/usr/share/mime", root()));
  EXPECT_THAT(outputOf(fmt::format("cat {}/usr/share/mime/globs2", root())),
              HasSubstr("80:application/x-spindrift-session:spindrift-session.json"));
  EXPECT_THAT(outputOf(fmt::format("cat {}/usr/share/applications/spindrift.desktop", root())),
              HasSubstr("MimeType=application/x-spindrift-session;"));
}

// Each page is set without a warning and tells every command and option that --help knows.
TEST_F(Package, ManPagesTellWhatTheProgramsTell) {
  for (const std::string program : {"spindrift", "spindrift-cli", "spindrift-fe"}) {
    const std::string page = fmt::format("{}/usr/share/man/man1/{}.1.gz", root(), program);
    EXPECT_EQ(outputOf(fmt::format("man --warnings -E UTF-8 -l -Tutf8 -Z {} 2>&1 >/dev/null", page)), "");
    EXPECT_THAT(outputOf("lexgrog " + page), HasSubstr(program + " - "));
    const std::string text = outputOf(fmt::format("MANWIDTH=200 man -l {} | col -bx", page));
    const std::string run = fmt::format("{}/usr/bin/{}", root(), program);
    const std::vector<std::string> options = linesIn(outputOf(
        run + " --help | grep -o -E '^ +(-[a-z], ?)?--[a-z-]+' | grep -o -E -- '--[a-z-]+' | grep -v help-all"));
    EXPECT_GE(options.size(), 3u);
    for (const std::string& option : options) EXPECT_THAT(text, HasSubstr(option)) << program;
  }
  const std::string text =
      outputOf(fmt::format("MANWIDTH=200 man -l {}/usr/share/man/man1/spindrift-cli.1.gz | col -bx", root()));
  const std::vector<std::string> commands = linesIn(outputOf(
      fmt::format("{}/usr/bin/spindrift-cli --help | sed '1,/^Subcommands:/d' | grep -o -E '^  [a-z0-9-]+ '", root())));
  EXPECT_GE(commands.size(), 30u);
  for (const std::string& command : commands)
    EXPECT_THAT(text, HasSubstr("spindrift-cli " + command.substr(2, command.size() - 3)));
}

// dpkg installed it, so that what is named is to be had; what is linked and what is only loaded is named.
TEST_F(Package, NamesWhatItNeeds) {
  const std::string depends = ", " + field("spindrift", "Depends");
  for (const std::string name :
       {"libc6 (", "libqt6widgets6 (", "libvtk9.1 (", "libopencv-core406 (", "libpcl-common1.13 (", "fonts-inter",
        "libegl1", "libgl1-mesa-dri", "libqt6svg6", "qt6-translations-l10n"})
    EXPECT_THAT(depends, HasSubstr(", " + name));
  EXPECT_EQ(shell(fmt::format("ldd {}/usr/bin/spindrift* | grep 'not found'", root())).output, "");
  EXPECT_THAT(field("spindrift", "Architecture"), HasSubstr(outputOf("dpkg --print-architecture")));
  EXPECT_THAT(outputOf(fmt::format("cat {}/var/lib/dpkg/status", root())),
              HasSubstr("Package: spindrift\nStatus: install ok installed\n"));
}

TEST_F(Package, RunsFromAnEmptyRoot) {
  const std::string cli = root() + "/usr/bin/spindrift-cli";
  EXPECT_EQ(outputOf(cli + " --version"), std::string(SPINDRIFT_VERSION) + "\n");
  EXPECT_EQ(outputOf(root() + "/usr/bin/spindrift-fe --version"), std::string(SPINDRIFT_VERSION) + "\n");
  const std::string window = "HOME=" + root() + " " + root() + "/usr/bin/spindrift";
  EXPECT_EQ(outputOf(window + " --version"), "spindrift " SPINDRIFT_VERSION "\n");
  EXPECT_THAT(outputOf(window + " --startup-time"), HasSubstr("first usable window"));
  // What is written again is what was packed: the manual holds no date.
  const std::string manual = (*folder_ / "manual.pdf").string();
  (void)outputOf(
      fmt::format("{0} manual --out {1} && cmp {1} {2}/usr/share/doc/spindrift/manual.pdf", cli, manual, root()));
  (void)outputOf(fmt::format("{0} --language de --manual {1} && cmp {1} {2}/usr/share/doc/spindrift/manual-de.pdf",
                             window, manual, root()));
  // A scenario of the package becomes a campaign, the campaign a model that knows its noise.
  const std::string campaign = (*folder_ / "campaign").string();
  (void)outputOf(
      fmt::format("{} simulate {}/usr/share/spindrift/scenarios/hole_bar.json --out {}", cli, root(), campaign));
  (void)outputOf(fmt::format("{} evaluate {} --json -", cli, campaign));
  // Nothing of the folder that it was built in is needed.
  EXPECT_EQ(shell(fmt::format("readelf -d {}/usr/bin/spindrift* | grep -i -E 'rpath|runpath'", root())).output, "");
}

// A controller's program, compiled from nothing but the development package, says what is wrong with its model.
TEST_F(Package, CompensatorRunsFromTheDevelopmentPackage) {
  const std::filesystem::path main =
      folder_->write("main.c",
                     "int compensate_one_minute(const char*, double, double*);\n"
                     "int main(void) { double c = 0.0; return compensate_one_minute(\"no-model.json\", 20.0, &c); }\n");
  const ShellOutcome built =
      shell(fmt::format("export PKG_CONFIG_PATH=$(dirname $(find {0} -name 'spindrift-compensator.pc')) && cc {1} "
                        "{0}/share/doc/spindrift-dev/examples/compensator_example.c $(pkg-config --cflags --libs "
                        "spindrift-compensator) -o {2}",
                        root() + "/usr", main.string(), (*folder_ / "example").string()));
  ASSERT_EQ(built.status, 0) << built.output;
  EXPECT_THAT(shell((*folder_ / "example").string()).output, HasSubstr("no-model.json"));
}

TEST_F(Package, HasNoErrorOfLintian) {
  EXPECT_EQ(shell(fmt::format("lintian --allow-root --no-cfg --tag-display-limit 0 --fail-on none --suppress-tags "
                              "uses-no-compression-for-data-tarball -L '>=error' {} {}",
                              deb("first", "spindrift"), deb("first", "spindrift-dev")))
                .output,
            "");
}

}  // namespace
}  // namespace spindrift::testing
