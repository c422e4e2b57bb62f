// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/rolling_bytes.hpp"
#include "proto/base/time.hpp"
#include "proto/record/codec.hpp"

#include <cstddef>
#include <deque>
#include <string>

namespace hapnet::peer::monitor {

/// The last rows of a record, encoded, in bounded memory: 20 s of two peers take 9 MB.
class HeldRows {
public:
    static constexpr std::size_t bytes_max = std::size_t{64} << 20;

    HeldRows(base::Duration span, const record::Layout& layout);

    void add(const record::Row& row);

    /// Returns the rows from `from` on. The last earlier agreement with each of the others comes
    /// first, because the rows have no meaning without it.
    [[nodiscard]] std::string since(base::TimePoint from) const;

private:
    struct Terms {
        base::TimePoint at;
        record::SessionRow row;
    };
    /// The largest number of agreements. One is noted each second with each of at most seven
    /// others.
    static constexpr std::size_t terms_max = std::size_t{8} * 600;

    record::Layout layout_;
    base::TimePoint now_{}; // time of the newest row
    base::RollingBytes rows_;
    std::deque<Terms> terms_;
};

} // namespace hapnet::peer::monitor
