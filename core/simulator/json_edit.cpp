// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/json_edit.h"

#include <algorithm>
#include <charconv>

#include "core/base/error.h"
#include "core/base/text.h"

namespace spindrift {
namespace {

struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;
};

struct Member {
  std::string key;  ///< empty in a list
  Span key_text;
  Span value;
};

std::size_t indexOf(const std::string& digits) {
  std::size_t index = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), index);
  SPINDRIFT_ASSERT(error == std::errc() && end == digits.data() + digits.size(), "the number of an element");
  return index;
}

/// Walks through the text of a document that is known to be valid.
class Walker {
 public:
  explicit Walker(const std::string& text) : text_(text) {}

  [[nodiscard]] std::size_t skipBlanks(std::size_t at) const {
    while (at < text_.size() && std::string_view(" \t\r\n").find(text_[at]) != std::string_view::npos) ++at;
    return at;
  }

  /// The end of the value that begins at `at`.
  [[nodiscard]] std::size_t endOf(std::size_t at) const {
    if (text_[at] == '"') {
      for (++at; text_[at] != '"'; ++at) {
        if (text_[at] == '\\') ++at;
      }
      return at + 1;
    }
    if (text_[at] == '{' || text_[at] == '[') {
      const std::vector<Member> inside = members(at);
      std::size_t end = inside.empty() ? at + 1 : inside.back().value.end;
      end = skipBlanks(end);
      return end + 1;
    }
    while (at < text_.size() && std::string_view(",]} \t\r\n").find(text_[at]) == std::string_view::npos) ++at;
    return at;
  }

  /// Members of the object or elements of the list that begins at `at`.
  [[nodiscard]] std::vector<Member> members(std::size_t at) const {
    std::vector<Member> out;
    const bool object = text_[at] == '{';
    at = skipBlanks(at + 1);
    while (text_[at] != '}' && text_[at] != ']') {
      Member member;
      if (object) {
        member.key_text = {at, endOf(at)};
        member.key = nlohmann::json::parse(text_.substr(at, member.key_text.end - at)).get<std::string>();
        at = skipBlanks(member.key_text.end);  // the colon
        at = skipBlanks(at + 1);
      }
      member.value = {at, endOf(at)};
      at = skipBlanks(member.value.end);
      out.push_back(std::move(member));
      if (text_[at] == ',') at = skipBlanks(at + 1);
    }
    return out;
  }

 private:
  const std::string& text_;
};

std::string textOf(const nlohmann::json& value) {
  return value.is_number_float() ? exactNumber(value.get<double>()) : value.dump();
}

/// "," and the blanks that stand before the first member of the object or list at `at`, as the author began it.
std::string separatorAt(const std::string& text, std::size_t at) {
  const std::size_t first = Walker(text).skipBlanks(at + 1);
  return "," + text.substr(at + 1, first - at - 1);
}

void insertMember(std::string& text, std::size_t at, const std::vector<Member>& members, const std::string& member) {
  if (members.empty()) {
    text.insert(at + 1, member);
  } else {
    text.insert(members.back().value.end, separatorAt(text, at) + member);
  }
}

void applyToText(std::string& text, const JsonEdit& edit) {
  std::size_t at = text.find('{');
  for (std::size_t i = 0; i < edit.path.size(); ++i) {
    const std::vector<Member> members = Walker(text).members(at);
    const bool last = i + 1 == edit.path.size();
    std::size_t found = members.size();
    if (text[at] == '[') {
      found = indexOf(edit.path[i]);
      SPINDRIFT_ASSERT(found < members.size(), "an element that is there");
    } else {
      for (std::size_t k = 0; k < members.size(); ++k) {
        if (members[k].key == edit.path[i]) found = k;
      }
    }
    if (found == members.size()) {
      if (!edit.value) return;
      nlohmann::json value = *edit.value;
      for (std::size_t k = edit.path.size(); k-- > i + 1;) value = nlohmann::json{{edit.path[k], value}};
      insertMember(text, at, members, nlohmann::json(edit.path[i]).dump() + ": " + textOf(value));
      return;
    }
    if (!last) {
      at = members[found].value.begin;
      continue;
    }
    if (edit.value) {
      const Span span = members[found].value;
      text.replace(span.begin, span.end - span.begin, textOf(*edit.value));
    } else if (members.size() == 1) {
      text.erase(members[0].key_text.begin, members[0].value.end - members[0].key_text.begin);
    } else if (found + 1 < members.size()) {
      const std::size_t begin = members[found].key_text.begin;
      text.erase(begin, members[found + 1].key_text.begin - begin);
    } else {
      const std::size_t begin = members[found - 1].value.end;
      text.erase(begin, members[found].value.end - begin);
    }
  }
}

}  // namespace

void applyEdit(nlohmann::json& document, const JsonEdit& edit) {
  SPINDRIFT_ASSERT(!edit.path.empty(), "a value within the document");
  nlohmann::json* node = &document;
  for (std::size_t i = 0; i + 1 < edit.path.size(); ++i) {
    if (node->is_array()) {
      node = &node->at(indexOf(edit.path[i]));
      continue;
    }
    if (!edit.value && !node->contains(edit.path[i])) return;
    node = &(*node)[edit.path[i]];
  }
  const std::string& key = edit.path.back();
  if (!edit.value) {
    node->erase(key);
  } else if (node->is_array()) {
    node->at(indexOf(key)) = *edit.value;
  } else {
    (*node)[key] = *edit.value;
  }
}

std::string editedJson(const std::string& text, const std::vector<JsonEdit>& edits) {
  std::string out = text;
  nlohmann::json expected = nlohmann::json::parse(text);
  for (const JsonEdit& edit : edits) {
    applyToText(out, edit);
    applyEdit(expected, edit);
  }
  SPINDRIFT_ASSERT(nlohmann::json::parse(out) == expected, "the text says what the document says");
  return out;
}

std::string appendedJson(const std::string& text, const std::string& key, const nlohmann::json& entry) {
  const nlohmann::json document = nlohmann::json::parse(text);
  if (!document.contains(key) || !document[key].is_array() || document[key].empty()) {
    return editedJson(text, {{{key}, nlohmann::json::array({entry})}});
  }
  std::string out = text;
  const Walker walker(text);
  for (const Member& member : walker.members(text.find('{'))) {
    if (member.key != key) continue;
    insertMember(out, member.value.begin, walker.members(member.value.begin), entry.dump());
  }
  nlohmann::json expected = document;
  expected[key].push_back(entry);
  SPINDRIFT_ASSERT(nlohmann::json::parse(out) == expected, "the text says what the document says");
  return out;
}

}  // namespace spindrift
