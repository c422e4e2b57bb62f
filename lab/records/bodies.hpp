// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/moments.hpp"
#include "lab/records/session.hpp"
#include "lab/virtual_time/trace.hpp"
#include "proto/base/space.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::records {

/// Returns the bodies that a session shared, as its records hold them: the bodies of which both
/// records have rows, or else the only body that the ticks hold. The result is never empty.
[[nodiscard]] std::vector<RecordedBody> bodies_shared_in(const record::Record& a,
                                                         const record::Record& b);

/// Returns the name of a body: "cube", or "body 3" if it has no name; "the body" when its record
/// does not name it.
[[nodiscard]] std::string name_of(const RecordedBody& body);
/// Returns the name within a sentence: "the cube".
[[nodiscard]] std::string named_in_text(const RecordedBody& body);

using virtual_time::Pose;

/// The poses of a body after the ticks of one side. It refers to the side.
class Poses {
public:
    Poses(const Side& side, const RecordedBody& body) : side_{side}, body_{body} {}

    /// Returns the pose after a tick; nullopt when its row is lost.
    [[nodiscard]] std::optional<Pose> at(const record::TickRow& tick) const;
    /// Returns the peer whose copy of the body counted, as the side saw it; 0: not recorded.
    [[nodiscard]] std::uint16_t owner_at(const record::TickRow& tick) const;

private:
    [[nodiscard]] const record::BodyRow* row_of(const record::TickRow& tick) const;

    const Side& side_;
    const RecordedBody& body_;
};

/// The distance and the angle between two copies of a body.
struct Apart {
    base::Displacement distance; // vector from B's copy to A's
    double angle_rad = 0.0;      // angle between the orientations of the copies, 0 to pi
};

/// The copies of one body in a session.
class Copies {
public:
    Copies(const Session& session, const RecordedBody& body)
        : a_{session.a, body}, b_{session.b, body}
    {}

    /// Returns the distance and the angle at a moment; nullopt: one of the rows is lost.
    [[nodiscard]] std::optional<Apart> apart_at(const Moment& moment) const;

    [[nodiscard]] const Poses& a() const { return a_; }
    [[nodiscard]] const Poses& b() const { return b_; }

private:
    Poses a_;
    Poses b_;
};

} // namespace hapnet::lab::records
