// SPDX-License-Identifier: Apache-2.0
// Line by line, word by word: the grammar of OBJ and MTL files.
#pragma once
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace luciole {

// The words of one line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view next() {  // empty at the end
    skip_space();
    const std::size_t length = std::min(rest_.find_first_of(kSpace), rest_.size());
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }
  // What is left, without the space around it.
  std::string_view rest() {
    skip_space();
    const std::size_t last = rest_.find_last_not_of(kSpace);
    return rest_.substr(0, last == std::string_view::npos ? 0 : last + 1);
  }
  // The next word as a finite number; nothing (and the word stays) if it is none. An exponent with its sign on the
  // wrong side, "3.1+e2", is left out as other readers do, and noted: 3.1.
  std::optional<float> number() {
    const std::string_view before = rest_;
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    float value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    const std::string_view tail(end, static_cast<std::size_t>(word.data() + word.size() - end));
    if (code == std::errc() && std::isfinite(value) && (tail.empty() || is_bad_exponent(tail))) {
      if (!tail.empty() && bad_number_.empty()) bad_number_ = word;
      return value;
    }
    // Smaller than any float is nothing, not an error.
    if (code == std::errc::result_out_of_range && tail.empty() && is_tiny(word)) return 0.0f;
    rest_ = before;
    return std::nullopt;
  }
  // The first number of which an exponent was left out; empty: none.
  std::string_view bad_number() const { return bad_number_; }

 private:
  static constexpr const char* kSpace = " \t\r\v\f";
  static bool is_bad_exponent(std::string_view tail) {
    return tail.starts_with("+e") || tail.starts_with("-e") || tail.starts_with("+E") || tail.starts_with("-E");
  }
  static bool is_tiny(std::string_view word) {
    double value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code == std::errc()) return std::abs(value) < 1;
    return word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
  }
  void skip_space() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpace), rest_.size())); }

  std::string_view rest_, bad_number_;
};

// The lines of a text, without comments; a backslash at the end of a line joins the next one.
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  // The next line, valid until the next call; nothing at the end of the text.
  std::optional<std::string_view> next() {
    if (rest_.empty()) return std::nullopt;
    std::string_view line = physical_line();
    if (line.ends_with('\\')) {
      joined_.clear();
      while (line.ends_with('\\')) {
        joined_.append(line.substr(0, line.size() - 1)).push_back(' ');
        line = rest_.empty() ? std::string_view() : physical_line();
      }
      line = joined_.append(line);
    }
    return without_comment(line);
  }
  std::size_t number() const { return number_; }  // of the line that next() gave, from 1

 private:
  // A comment begins a line or follows a space: names and broken numbers ("1.#IND") may hold the sign themselves.
  static std::string_view without_comment(std::string_view line) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) return line.substr(0, i);
    }
    return line;
  }
  std::string_view physical_line() {
    const std::size_t length = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    ++number_;
    return line;
  }

  std::string_view rest_;
  std::string joined_;
  std::size_t number_ = 0;
};

}  // namespace luciole
