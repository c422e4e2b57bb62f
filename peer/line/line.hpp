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

/// Messages go as they are, to one place, and are taken from it alone. See Line.
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
        // No message of ours is as long as that, so most are not looked into.
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

/// Between a side of a session, whose messages are plain, and the network: with a key all that
/// leaves is sealed, and only what the other side has sealed comes in. Does no I/O and reads no
/// clock: feed with open() and tick(), drain with send_all() and news().
class Line {
public:
    /// A line without a key.
    explicit Line(const secure::Place& other) : kind_{Plain{other}} {}
    explicit Line(std::unique_ptr<Sealed> sealed) : kind_{std::move(sealed)} {}

    /// True if a datagram says that it is for this line and not for another one of the same peer:
    /// by the key or the handshake that it names. A seal is not looked at.
    [[nodiscard]] bool is_named_by(std::span<const std::byte> datagram) const
    {
        return is_sealed() && sealed()->is_named_by(datagram);
    }
    /// True if the other side is at this place, as far as is known.
    [[nodiscard]] bool leads_to(const secure::Place& place) const
    {
        const auto* plain = std::get_if<Plain>(&kind_);
        return plain == nullptr ? sealed()->place() == place : plain->place() == place;
    }

    /// The plain message in a datagram; nullopt: it has none for this side. Valid until the next
    /// call, and no longer than the datagram.
    [[nodiscard]] std::optional<std::span<const std::byte>>
    open(std::span<const std::byte> datagram, const secure::Place& from, base::TimePoint now)
    {
        if (auto* plain = std::get_if<Plain>(&kind_)) return plain->open(datagram, from);
        return own_sealed()->open(datagram, from, now);
    }

    /// Advances handshakes and keys. Call it once a tick, after urgent work. Takes at most one
    /// multiplication on the curve.
    void tick(secure::Moment moment)
    {
        if (is_sealed()) own_sealed()->tick(moment);
    }

    /// Calls send(bytes, place) for everything to be sent: first the datagrams of handshakes, then
    /// the messages that `poll` gives. Messages for which there is no key yet are left out.
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
    /// Datagrams from elsewhere; with a key the place says nothing, and the seal does.
    [[nodiscard]] std::uint64_t strangers() const
    {
        const auto* plain = std::get_if<Plain>(&kind_);
        return plain == nullptr ? 0 : plain->strangers();
    }
    /// nullptr without a key.
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
