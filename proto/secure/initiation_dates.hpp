// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::secure {

/// Recognises new initiations of the other side by the dates in them. A date is final once its
/// handshake made a key that the other side used: nothing older is taken again. Until then it may
/// be that of a recorded initiation of a former run, and the other side's clock may have gone back
/// since: for a while nothing older is taken, afterwards nothing older of the same run. So each
/// recorded initiation is taken once, and shuts the present run out for no longer than that while.
class InitiationDates {
public:
    /// Duration for which a date also counts for other runs: as long as an initiator waits for its
    /// key.
    static constexpr base::Duration unconfirmed_lasts{std::chrono::seconds{5}};
    /// Runs whose unconfirmed dates are remembered; of more the one taken longest ago is forgotten.
    static constexpr std::size_t runs_max = 32;

    /// Remembers that date, in ns since 1970, when it is new; returns whether it was. `run` is the
    /// sender's and not 0. Call it only when the initiation is proven to be the other side's.
    [[nodiscard]] bool take(std::uint32_t run, std::int64_t date, base::TimePoint now)
    {
        if (confirmed_ && date <= *confirmed_) return false;
        for (const Taken& taken : taken_) {
            const bool counts = taken.run == run || now - taken.at < unconfirmed_lasts;
            if (taken.run != 0 && counts && date <= taken.date) return false;
        }
        place_of(run) = {run, date, now};
        return true;
    }
    /// The other side has used the key of the initiation with that date.
    void confirm(std::int64_t date) { confirmed_ = std::max(date, confirmed_.value_or(date)); }

private:
    struct Taken {
        std::uint32_t run = 0; // 0: unused
        std::int64_t date = 0; // newest date of that run
        base::TimePoint at;
    };

    [[nodiscard]] Taken& place_of(std::uint32_t run)
    {
        const auto same = std::ranges::find(taken_, run, &Taken::run);
        if (same != taken_.end()) return *same;
        const auto unused = std::ranges::find(taken_, std::uint32_t{0}, &Taken::run);
        if (unused != taken_.end()) return *unused;
        return *std::ranges::min_element(taken_, {}, &Taken::at);
    }

    std::optional<std::int64_t> confirmed_;
    std::array<Taken, runs_max> taken_{};
};

} // namespace hapnet::secure
