// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/probability.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// Reads the words of a tc sentence one after the other, in the units of tc. It keeps the first
/// error; words after an error have no effect.
class NetemWords {
public:
    explicit NetemWords(std::string_view sentence);

    [[nodiscard]] bool at_end() const { return next_ == words_.size(); }
    /// Takes the next word. `expected` describes what is missing if the sentence ends here: "a
    /// time, such as 80ms".
    [[nodiscard]] std::string take(std::string_view expected);
    /// Takes the next word if it equals `word`.
    [[nodiscard]] bool take_if(std::string_view word);

    // Each function takes the next word. The optional ones take it only if it begins like a number.

    /// Takes a time. A number without a unit is in microseconds, and is stored in bare_times().
    [[nodiscard]] base::Duration time();
    [[nodiscard]] base::Probability share();
    [[nodiscard]] std::uint64_t count(std::uint64_t most);
    [[nodiscard]] std::uint64_t bits_per_second();
    [[nodiscard]] std::optional<base::Duration> optional_time();
    [[nodiscard]] std::optional<base::Probability> optional_share();
    [[nodiscard]] std::optional<std::int64_t> optional_integer();

    void complain(const std::string& what);
    [[nodiscard]] const std::optional<std::string>& complaint() const { return complaint_; }
    /// Returns the times that were written without a unit.
    [[nodiscard]] const std::vector<std::string>& bare_times() const { return bare_times_; }

private:
    [[nodiscard]] bool is_number_next() const;
    [[nodiscard]] bool is_time_next() const;

    std::vector<std::string> words_;
    std::size_t next_ = 0;
    std::vector<std::string> bare_times_;
    std::optional<std::string> complaint_;
};

} // namespace hapnet::emulator::tools
