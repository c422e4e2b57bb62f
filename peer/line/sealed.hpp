// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/line/datagram.hpp"
#include "peer/line/news.hpp"
#include "proto/base/time.hpp"
#include "proto/secure/association.hpp"
#include "proto/wire/message.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::peer::line {

/// Seals messages and sends them to the place from which the other side was last heard. It is one
/// kind of Line.
class Sealed {
public:
    /// The number of events of one kind after which a problem is reported. A single event may be
    /// damage or an attack.
    static constexpr std::uint64_t trouble_needed = 3;
    /// The number of restarts of the other side within `restarts_within` that shows that two
    /// programs use the same key and displace each other.
    static constexpr std::size_t restarts_suspected = 3;
    static constexpr base::Duration restarts_within{std::chrono::seconds{30}};

    /// `config.session_of` is ignored, as it is always that of the messages.
    Sealed(secure::Association::Config config, secure::StaticKeys keys, secure::Secret seed);

    /// True if a datagram claims to belong to this line, by the key or the handshake that it names.
    [[nodiscard]] bool is_named_by(std::span<const std::byte> datagram) const
    {
        return association_.is_named_by(datagram);
    }
    [[nodiscard]] std::optional<std::span<const std::byte>>
    open(std::span<const std::byte> datagram, const secure::Place& from, base::TimePoint now);
    void tick(secure::Moment moment);
    /// Takes the next datagram that a handshake has to send.
    [[nodiscard]] std::optional<secure::Association::Outgoing> poll()
    {
        return association_.poll();
    }
    /// Seals a message; nullopt if there is no key. The result is valid until the next call.
    [[nodiscard]] std::optional<std::span<const std::byte>> seal(std::span<const std::byte> message,
                                                                 base::TimePoint now);
    [[nodiscard]] std::optional<News> news() { return news_.take(); }

    [[nodiscard]] const std::optional<secure::Place>& place() const { return association_.place(); }
    [[nodiscard]] bool has_key(base::TimePoint now) const { return association_.has_key(now); }
    [[nodiscard]] std::optional<base::Duration> key_age(base::TimePoint now) const
    {
        return association_.key_age(now);
    }
    [[nodiscard]] const secure::Association::Counts& counts() const
    {
        return association_.counts();
    }
    /// Returns the number of hellos that name another run or another id than their key.
    [[nodiscard]] std::uint64_t misnamed() const { return misnamed_; }

private:
    [[nodiscard]] bool is_of_its_key(std::span<const std::byte> message,
                                     std::uint32_t other_run) const;
    void look_for_news(base::TimePoint now);
    void on_restart(base::TimePoint now);

    std::uint8_t other_id_;
    secure::Association association_;
    Datagram incoming_, outgoing_;
    std::uint64_t misnamed_ = 0;
    std::uint64_t plain_hellos_ = 0;
    secure::Association::Counts before_; // counts in the previous tick
    PendingNews news_;
    std::array<base::TimePoint, restarts_suspected> restarts_{}; // ring of the newest restarts
    std::uint64_t restart_count_ = 0;
};

} // namespace hapnet::peer::line
