// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/line/line.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::peer::line {

/// The lines to all other peers of a session, in the order of its roster. Finds the line that a
/// datagram belongs to, and advances the keys of the lines in turn. Either all lines have keys or
/// none has.
class Lines {
public:
    /// `lines` must not be empty.
    explicit Lines(std::vector<Line> lines);

    struct Opened {
        std::size_t from = 0; // index of the line
        std::span<const std::byte> message;
    };
    /// Returns the plain message in a datagram; nullopt if it contains none for this side. It is
    /// valid until the next call, and no longer than the datagram.
    [[nodiscard]] std::optional<Opened> open(std::span<const std::byte> datagram,
                                             const secure::Place& from, base::TimePoint now);
    /// Advances the keys of one line; successive calls take the lines in turn. Call it once a tick.
    /// It does at most one multiplication on the curve, however many lines there are.
    void tick(secure::Moment moment);

    [[nodiscard]] Line& operator[](std::size_t of) { return lines_[of]; }
    [[nodiscard]] const Line& operator[](std::size_t of) const { return lines_[of]; }
    [[nodiscard]] std::size_t size() const { return lines_.size(); }
    [[nodiscard]] bool are_sealed() const { return lines_.front().is_sealed(); }
    /// Returns the number of datagrams without a key that came from none of the others' places.
    [[nodiscard]] std::uint64_t strangers() const { return lines_.front().strangers(); }

private:
    std::vector<Line> lines_;
    std::size_t next_ = 0; // line whose keys advance in the next tick
};

} // namespace hapnet::peer::line
