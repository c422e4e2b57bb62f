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

/// The last seconds of a stream of pieces, each of a time, in a ring of bounded memory: what a
/// flight recorder holds. Whatever is older than its span, or finds no room, makes way.
class RollingBytes {
public:
    /// Memory that is never used is never touched.
    RollingBytes(Duration span, std::size_t bytes_max);

    /// Times ascend; one that goes back counts as the newest so far. A piece longer than the ring
    /// is left out.
    void add(TimePoint at, std::string_view piece);

    /// The pieces from that time on, in the order in which they came.
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
