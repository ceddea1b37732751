// SPDX-License-Identifier: Apache-2.0
// The name of a content: two inputs with the same SHA-256 (FIPS 180-4) are the same input.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;

namespace spindrift {

/// A content that grows: what was added so far has its name at any time. A copy goes on by itself.
class Sha256 {
 public:
  Sha256();
  Sha256(const Sha256& other);
  Sha256& operator=(const Sha256& other);
  Sha256(Sha256&&) noexcept = default;
  Sha256& operator=(Sha256&&) noexcept = default;
  ~Sha256() = default;

  void add(std::string_view part);
  /// The name of what was added so far, as 32 bytes.
  [[nodiscard]] std::string bytes() const;
  /// The same as 64 hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view content);
/// The same of a file, which is never held whole. Throws InputError if it cannot be read.
[[nodiscard]] std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace spindrift
