// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <string_view>

namespace hapnet::base {

/// The last seconds of a stream of pieces with times, in a ring of bounded memory, as for a flight
/// recorder. Pieces that are older than the span are dropped, and the oldest are dropped when there
/// is no room.
class RollingBytes {
public:
    /// Allocates `bytes_max` bytes, but touches none of them before they are used.
    RollingBytes(Duration span, std::size_t bytes_max);

    /// Adds a piece. Times should ascend: a time before that of the newest piece is replaced by it.
    /// A piece longer than the ring is left out.
    void add(TimePoint at, std::string_view piece);

    /// Returns the pieces from `from` on, in the order in which they were added.
    [[nodiscard]] std::string since(TimePoint from) const;

    [[nodiscard]] std::size_t pieces() const { return pieces_.size(); }

private:
    struct Piece {
        TimePoint at;
        std::size_t bytes = 0;
    };

    void drop_oldest();

    Duration span_;
    std::size_t capacity_;
    std::unique_ptr<char[]> ring_; // NOLINT(modernize-avoid-c-arrays): not filled with zeros
    std::size_t begin_ = 0;        // start of the oldest piece
    std::size_t used_ = 0;
    std::deque<Piece> pieces_;
};

} // namespace hapnet::base
