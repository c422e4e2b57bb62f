// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/line/line.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"
#include "proto/secure/association.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer::line {

/// The status of the line to the other peer at one time, from which statistics are made.
struct Status {
    /// The status of a line with a key.
    struct Key {
        bool is_agreed = false;
        std::optional<base::Duration> age; // age of the key in use
        secure::Association::Counts counts;
        std::uint64_t misnamed = 0;
        std::optional<secure::Place> place; // place of the other side
    };
    std::uint64_t strangers = 0; // datagrams from places other than that of the other side
    std::optional<Key> key;      // nullopt: messages are plain
};

constexpr auto fields_of(base::Tag<Status::Key>)
{
    using K = Status::Key;
    return base::fields(
        "secure", base::member("agreed", &K::is_agreed, "Whether there is a key to seal with."),
        base::member("key_age_s", &K::age, "How long ago it was made."), base::part(&K::counts),
        base::member("misnamed", &K::misnamed,
                     "Hellos that name another peer or run than their key."));
}

[[nodiscard]] inline Status status_of(const Line& line, base::TimePoint now)
{
    Status status{.strangers = line.strangers(), .key = {}};
    if (const Sealed* sealed = line.sealed()) {
        status.key = Status::Key{.is_agreed = sealed->has_key(now),
                                 .age = sealed->key_age(now),
                                 .counts = sealed->counts(),
                                 .misnamed = sealed->misnamed(),
                                 .place = sealed->place()};
    }
    return status;
}

} // namespace hapnet::peer::line
