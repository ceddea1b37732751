// SPDX-License-Identifier: Apache-2.0
#include "core/base/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "core/base/error.h"
#include "core/base/file_reader.h"

namespace spindrift {
void Sha256::Free::operator()(evp_md_ctx_st* context) const {
  ::EVP_MD_CTX_free(context);
}

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  const bool begun = context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
  SPINDRIFT_ASSERT(begun, "SHA-256 is always there");
}

Sha256::Sha256(const Sha256& other) : context_(EVP_MD_CTX_new()) {
  const bool copied = context_ && EVP_MD_CTX_copy_ex(context_.get(), other.context_.get()) == 1;
  SPINDRIFT_ASSERT(copied, "SHA-256 is always there");
}

Sha256& Sha256::operator=(const Sha256& other) {
  if (this != &other) *this = Sha256(other);
  return *this;
}

void Sha256::add(std::string_view part) {
  (void)EVP_DigestUpdate(context_.get(), part.data(), part.size());
}

std::string Sha256::bytes() const {
  const Sha256 ended(*this);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  const int done = EVP_DigestFinal_ex(ended.context_.get(), digest.data(), &size);
  SPINDRIFT_ASSERT(done == 1 && size == 32, "SHA-256 is always there");
  return {digest.begin(), digest.begin() + size};
}

std::string Sha256::text() const {
  std::string text;
  for (const char byte : bytes()) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

std::string sha256(std::string_view content) {
  Sha256 digest;
  digest.add(content);
  return digest.text();
}

std::string sha256OfFile(const std::filesystem::path& file) {
  FileReader reader(file);
  Sha256 digest;
  std::array<char, std::size_t{1} << 16> buffer;
  while (const std::size_t count = reader.read(buffer)) digest.add({buffer.data(), count});
  return digest.text();
}

}  // namespace spindrift
