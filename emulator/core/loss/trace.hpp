// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// Which datagrams of a recorded run were lost. Begins again at its end. Never empty.
class LossTrace {
public:
    static constexpr std::size_t datagrams_max = 10'000'000;

    /// Ensures that there is at least one and at most datagrams_max.
    explicit LossTrace(std::vector<bool> lost);

    [[nodiscard]] bool is_lost(std::uint64_t number) const { return lost_[number % lost_.size()]; }
    [[nodiscard]] std::size_t size() const { return lost_.size(); }
    [[nodiscard]] std::size_t losses() const { return losses_; }

    friend bool operator==(const LossTrace&, const LossTrace&) = default;

private:
    std::vector<bool> lost_;
    std::size_t losses_;
};

/// A file of 0 (arrived) and 1 (lost), one after the other; blanks and line ends between them mean
/// nothing, and '#' begins a comment. Errors name the line.
[[nodiscard]] base::Result<LossTrace> parse_loss_trace(std::string_view text);

/// The column `lost` (0 or 1) of a table with a header line and commas.
[[nodiscard]] base::Result<LossTrace> parse_loss_table(std::string_view text);

/// "0010": of every four datagrams the third is lost. At most 10^6 digits.
[[nodiscard]] base::Result<std::vector<bool>> parse_pattern(std::string_view text);
[[nodiscard]] std::string to_text(const std::vector<bool>& pattern);

} // namespace hapnet::emulator
