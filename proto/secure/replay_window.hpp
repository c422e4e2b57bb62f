// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace hapnet::secure {

/// Which numbers have come already: at least the last `bits` below the newest are remembered, and
/// what is older counts as come. The ring of RFC 6479: a word is cleared when the newest enters it,
/// nothing is shifted.
template <std::size_t bits>
class ReplayWindow {
public:
    static_assert(bits % 64 == 0);

    /// Whether that number has not come yet.
    [[nodiscard]] bool is_fresh(std::uint32_t number) const
    {
        if (is_empty_) return true;
        if (number > newest_) return true;
        if (newest_ - number >= bits) return false;
        return (words_[word_of(number)] & bit_of(number)) == 0;
    }

    /// Remembers it; returns whether it is the newest. Call it only when the message is proven to
    /// be genuine: else one forged message would shut out all that come after it.
    bool note(std::uint32_t number)
    {
        const bool is_newest = is_empty_ || number > newest_;
        if (is_empty_) {
            is_empty_ = false;
            newest_ = number;
        } else if (is_newest) {
            const std::uint32_t from = newest_ / 64, to = number / 64;
            const std::size_t entered = to - from < count ? to - from : count;
            for (std::size_t i = 1; i <= entered; ++i) words_[(from + i) % count] = 0;
            newest_ = number;
        }
        words_[word_of(number)] |= bit_of(number);
        return is_newest;
    }

private:
    static constexpr std::size_t count = bits / 64 + 1; // the newest word may be all but empty

    [[nodiscard]] static std::size_t word_of(std::uint32_t number) { return number / 64 % count; }
    [[nodiscard]] static std::uint64_t bit_of(std::uint32_t number)
    {
        return std::uint64_t{1} << (number % 64);
    }

    std::array<std::uint64_t, count> words_{};
    std::uint32_t newest_ = 0;
    bool is_empty_ = true;
};

} // namespace hapnet::secure
