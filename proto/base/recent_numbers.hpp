// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::base {

/// The answer to the question of whether a number was seen before.
enum class Seen : std::uint8_t { no, yes, too_old_to_tell };

/// Remembers which numbers have been seen, among the highest one and the `looks_back - 1` below it.
/// The ring of RFC 6479: a word is cleared when the highest number enters it, and nothing is
/// shifted.
template <std::size_t looks_back>
class RecentNumbers {
public:
    static_assert(looks_back % 64 == 0);

    [[nodiscard]] Seen find(std::uint64_t number) const
    {
        if (!highest_ || number > *highest_) return Seen::no;
        if (*highest_ - number >= looks_back) return Seen::too_old_to_tell;
        return (words_[word_of(number)] & bit_of(number)) != 0 ? Seen::yes : Seen::no;
    }

    /// Returns the same as find(), and then remembers the number unless it is too old.
    Seen add(std::uint64_t number)
    {
        const Seen seen = find(number);
        if (seen == Seen::too_old_to_tell) return seen;
        if (highest_ && number > *highest_) {
            const std::uint64_t from = *highest_ / 64;
            const auto entered = std::min<std::uint64_t>(number / 64 - from, words);
            for (std::uint64_t i = 1; i <= entered; ++i) words_[(from + i) % words] = 0;
        }
        highest_ = std::max(highest_.value_or(number), number);
        words_[word_of(number)] |= bit_of(number);
        return seen;
    }

    /// Returns the highest number so far; nullopt before the first one.
    [[nodiscard]] std::optional<std::uint64_t> highest() const { return highest_; }

private:
    static constexpr std::size_t words = looks_back / 64 + 1; // the newest may be almost empty

    [[nodiscard]] static std::size_t word_of(std::uint64_t number) { return number / 64 % words; }
    [[nodiscard]] static std::uint64_t bit_of(std::uint64_t number)
    {
        return std::uint64_t{1} << (number % 64);
    }

    std::array<std::uint64_t, words> words_{};
    std::optional<std::uint64_t> highest_;
};

} // namespace hapnet::base
