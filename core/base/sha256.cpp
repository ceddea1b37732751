// SPDX-License-Identifier: Apache-2.0
#include "core/base/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <memory>

#include "core/base/error.h"
#include "core/base/file_reader.h"

namespace spindrift {
namespace {

struct Free {
  void operator()(EVP_MD_CTX* context) const { ::EVP_MD_CTX_free(context); }
};

/// A digest that is fed piece by piece.
class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new()) {
    const bool begun = context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
    SPINDRIFT_ASSERT(begun, "SHA-256 is always there");
  }
  void add(std::string_view part) { (void)EVP_DigestUpdate(context_.get(), part.data(), part.size()); }
  std::string text() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    const int done = EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    SPINDRIFT_ASSERT(done == 1 && size == 32, "SHA-256 is always there");
    std::string text;
    for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, Free> context_;
};

}  // namespace

std::string sha256(std::string_view content) {
  Digest digest;
  digest.add(content);
  return digest.text();
}

std::string sha256OfFile(const std::filesystem::path& file) {
  FileReader reader(file);
  Digest digest;
  std::array<char, std::size_t{1} << 16> buffer;
  while (const std::size_t count = reader.read(buffer)) digest.add({buffer.data(), count});
  return digest.text();
}

}  // namespace spindrift
