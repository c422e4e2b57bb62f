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

/// The last rows of a record, as they are written, in bounded memory: 20 s of two peers take 9 MB.
class HeldRows {
public:
    static constexpr std::size_t bytes_max = std::size_t{64} << 20;

    HeldRows(base::Duration span, const record::Layout& layout);

    void add(const record::Row& row);

    /// The rows from that time on. The agreement with each of the others that held before it comes
    /// first: the rest means nothing without it.
    [[nodiscard]] std::string since(base::TimePoint from) const;

private:
    struct Terms {
        base::TimePoint at;
        record::SessionRow row;
    };
    /// Agreements are noted once a second with each of at most seven others.
    static constexpr std::size_t terms_max = std::size_t{8} * 600;

    record::Layout layout_;
    base::TimePoint now_{}; // time of the newest row
    base::RollingBytes rows_;
    std::deque<Terms> terms_;
};

} // namespace hapnet::peer::monitor
