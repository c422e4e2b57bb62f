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

/// The words of a tc sentence, read one after the other, in the units of tc; keeps the first
/// complaint about them. Words after a complaint no longer matter.
class NetemWords {
public:
    explicit NetemWords(std::string_view sentence);

    [[nodiscard]] bool at_end() const { return next_ == words_.size(); }
    /// `expected` is what a sentence that ends here lacks: "a time, such as 80ms".
    [[nodiscard]] std::string take(std::string_view expected);
    /// Takes the next word if it is this one.
    [[nodiscard]] bool take_if(std::string_view word);

    // Each function takes the next word. The optional ones take it only where it begins like a
    // number.

    /// A bare number is in microseconds, and is remembered in bare_times().
    [[nodiscard]] base::Duration time();
    [[nodiscard]] base::Probability share();
    [[nodiscard]] std::uint64_t count(std::uint64_t most);
    [[nodiscard]] std::uint64_t bits_per_second();
    [[nodiscard]] std::optional<base::Duration> optional_time();
    [[nodiscard]] std::optional<base::Probability> optional_share();
    [[nodiscard]] std::optional<std::int64_t> optional_integer();

    void complain(const std::string& what);
    [[nodiscard]] const std::optional<std::string>& complaint() const { return complaint_; }
    /// Times that were written without a unit.
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
