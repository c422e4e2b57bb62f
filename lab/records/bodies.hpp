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

/// The bodies that a session shared, as its records hold them: those that both have rows of, or
/// else the only one that the ticks hold. Never empty.
[[nodiscard]] std::vector<RecordedBody> bodies_shared_in(const record::Record& a,
                                                         const record::Record& b);

/// "cube", or "body 3" of one without a name; "the body" when its record does not say.
[[nodiscard]] std::string name_of(const RecordedBody& body);
/// "the cube", within a sentence.
[[nodiscard]] std::string named_in_text(const RecordedBody& body);

using virtual_time::Pose;

/// The poses of a body after the ticks of one side. Refers into the side.
class Poses {
public:
    Poses(const Side& side, const RecordedBody& body) : side_{side}, body_{body} {}

    /// Returns nullopt when its row is lost.
    [[nodiscard]] std::optional<Pose> at(const record::TickRow& tick) const;
    /// The peer whose copy of the body counted, as the side saw it; 0: not recorded.
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

    /// The distance and the angle at a moment; nullopt: a row of it is lost.
    [[nodiscard]] std::optional<Apart> apart_at(const Moment& moment) const;

    [[nodiscard]] const Poses& a() const { return a_; }
    [[nodiscard]] const Poses& b() const { return b_; }

private:
    Poses a_;
    Poses b_;
};

} // namespace hapnet::lab::records
