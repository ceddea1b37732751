// SPDX-License-Identifier: Apache-2.0
#include "core/base/inside_folder.h"

#include <fmt/format.h>

#include <algorithm>

namespace spindrift {
namespace {

namespace fs = std::filesystem;

/// Where a path leads once all links are followed; as it stands where that cannot be found out (a ring of links). The
/// empty path is the working folder, as for a file that is named alone.
fs::path real(const fs::path& path) {
  std::error_code error;
  fs::path out = fs::weakly_canonical(fs::absolute(path.empty() ? fs::path(".") : path), error);
  return error ? fs::path() : out;
}

bool liesIn(const fs::path& folder, const fs::path& path) {
  return !path.empty() && std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

fs::path InsideFolder::path(std::string_view relative, const SourcePlace& place) {
  const fs::path wanted(relative);
  const auto refuse = [&](std::string_view why) {
    throw InputError(place,
                     fmt::format("\"{}\" {}; allowed: a file inside the folder, given relative to it.", relative, why));
  };
  if (wanted.is_absolute()) refuse("is an absolute path");
  if (relative.find('\0') != std::string_view::npos) refuse("is not a file name");
  const fs::path normal = wanted.lexically_normal();
  if (normal.empty() || normal == "." || *normal.begin() == "..") refuse("leaves its folder");
  if (real_.empty()) real_ = real(folder_);
  const fs::path file = folder_ / wanted;
  const auto [known, unseen] = parents_.try_emplace(file.parent_path(), false);
  if (unseen) known->second = liesIn(real_, real(file.parent_path()));
  std::error_code none;
  if (!known->second || (fs::is_symlink(file, none) && !liesIn(real_, real(file))))
    refuse("leads out of its folder by a link");
  return file;
}

}  // namespace spindrift
