// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/line/news.hpp"
#include "peer/line/sealed.hpp"
#include "proto/base/time.hpp"
#include "proto/secure/association.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <variant>

namespace hapnet::peer::line {

/// Sends plain messages to one place, and accepts them only from it. See Line.
class Plain {
public:
    explicit Plain(const secure::Place& other) : place_{other} {}

    [[nodiscard]] std::optional<std::span<const std::byte>>
    open(std::span<const std::byte> datagram, const secure::Place& from)
    {
        if (!secure::is_same(from, place_)) {
            ++strangers_;
            return std::nullopt;
        }
        // No plain message is as long as an initiation, so most datagrams are not examined further.
        if (datagram.size() == secure::initiation_bytes) look_for_key(datagram);
        return datagram;
    }
    [[nodiscard]] std::optional<News> news() { return news_.take(); }

    [[nodiscard]] const secure::Place& place() const { return place_; }
    [[nodiscard]] std::uint64_t strangers() const { return strangers_; }

private:
    void look_for_key(std::span<const std::byte> datagram)
    {
        if (secure::frame_type_of(datagram) != secure::FrameType::initiation) return;
        if (initiations_ < Sealed::trouble_needed && ++initiations_ == Sealed::trouble_needed)
            news_.put(News::other_is_sealed);
    }

    secure::Place place_;
    std::uint64_t strangers_ = 0;
    std::uint64_t initiations_ = 0; // initiations from a side that has a key
    PendingNews news_;
};

/// Connects a side of a session, whose messages are plain, to the network. With a key, all outgoing
/// messages are sealed, and only messages that the other side has sealed are accepted. Does no I/O
/// and reads no clock: feed it with open() and tick(), drain it with send_all() and news().
class Line {
public:
    /// A line without a key.
    explicit Line(const secure::Place& other) : kind_{Plain{other}} {}
    explicit Line(std::unique_ptr<Sealed> sealed) : kind_{std::move(sealed)} {}

    /// True if a datagram claims to belong to this line of the peer, by the key or the handshake
    /// that it names. The seal is not checked.
    [[nodiscard]] bool is_named_by(std::span<const std::byte> datagram) const
    {
        return is_sealed() && sealed()->is_named_by(datagram);
    }
    /// True if the other side is at this place, as far as known.
    [[nodiscard]] bool leads_to(const secure::Place& place) const
    {
        const auto* plain = std::get_if<Plain>(&kind_);
        return plain == nullptr ? sealed()->place() == place : plain->place() == place;
    }

    /// Returns the plain message in a datagram; nullopt if it contains none for this side. It is
    /// valid until the next call, and no longer than the datagram.
    [[nodiscard]] std::optional<std::span<const std::byte>>
    open(std::span<const std::byte> datagram, const secure::Place& from, base::TimePoint now)
    {
        if (auto* plain = std::get_if<Plain>(&kind_)) return plain->open(datagram, from);
        return own_sealed()->open(datagram, from, now);
    }

    /// Advances handshakes and keys. Call it once a tick, after more urgent work. Does at most one
    /// multiplication on the curve.
    void tick(secure::Moment moment)
    {
        if (is_sealed()) own_sealed()->tick(moment);
    }

    /// Calls send(bytes, place) for everything that is to be sent: first the datagrams of
    /// handshakes, then the messages that `poll` returns. Messages are left out while there is no
    /// key for them.
    template <typename Poll, typename Send>
    void send_all(Poll poll, Send send, base::TimePoint now)
    {
        if (const auto* plain = std::get_if<Plain>(&kind_)) {
            while (const auto message = poll()) send(message->bytes(), plain->place());
            return;
        }
        Sealed& sealed = *own_sealed();
        while (const auto frame = sealed.poll()) send(frame->frame.bytes(), frame->to);
        while (const auto message = poll()) {
            const auto bytes = sealed.seal(message->bytes(), now);
            if (bytes) send(*bytes, *sealed.place());
        }
    }

    /// Takes the next news for a person; nullopt: there is none.
    [[nodiscard]] std::optional<News> news()
    {
        if (auto* plain = std::get_if<Plain>(&kind_)) return plain->news();
        return own_sealed()->news();
    }

    [[nodiscard]] bool is_sealed() const { return !std::holds_alternative<Plain>(kind_); }
    /// Returns the number of datagrams from other places. It is 0 with a key, because the seal and
    /// not the place identifies the sender.
    [[nodiscard]] std::uint64_t strangers() const
    {
        const auto* plain = std::get_if<Plain>(&kind_);
        return plain == nullptr ? 0 : plain->strangers();
    }
    /// Returns the sealed line; nullptr without a key.
    [[nodiscard]] const Sealed* sealed() const
    {
        const auto* sealed = std::get_if<std::unique_ptr<Sealed>>(&kind_);
        return sealed == nullptr ? nullptr : sealed->get();
    }

private:
    [[nodiscard]] Sealed* own_sealed() { return std::get<std::unique_ptr<Sealed>>(kind_).get(); }

    std::variant<Plain, std::unique_ptr<Sealed>> kind_;
};

} // namespace hapnet::peer::line
