// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/line/sealed.hpp"

#include <utility>
#include <variant>

namespace hapnet::peer::line {

namespace {

secure::Association::Config with_sessions(secure::Association::Config config)
{
    config.session_of = wire::session_number;
    return config;
}

} // namespace

Sealed::Sealed(secure::Association::Config config, secure::StaticKeys keys, secure::Secret seed)
    : other_id_{config.other_id},
      association_{with_sessions(config), std::move(keys), std::move(seed)}
{}

std::optional<std::span<const std::byte>>
Sealed::open(std::span<const std::byte> datagram, const secure::Place& from, base::TimePoint now)
{
    if (datagram.size() > Datagram::bytes_max) datagram = datagram.first(Datagram::bytes_max);
    incoming_.assign(datagram);
    const std::span<std::byte> bytes = incoming_.room().first(datagram.size());
    if (const auto opened = association_.on_datagram(bytes, from, now)) {
        const std::span<const std::byte> message = bytes.first(opened->size);
        if (is_of_its_key(message, opened->other_run)) return message;
        ++misnamed_;
        return std::nullopt;
    }
    // Plain hellos are reported only while there is no key, because they explain why.
    if (plain_hellos_ >= trouble_needed || association_.has_key(now)) return std::nullopt;
    if (wire::is_hello(datagram) && ++plain_hellos_ == trouble_needed)
        news_.put(News::other_is_plain);
    return std::nullopt;
}

/// True if a message fits its key, which belongs to one run of one peer: no member of a circle can
/// impersonate another. States and goodbyes need no check, because they name the session, which
/// belongs to the key.
bool Sealed::is_of_its_key(std::span<const std::byte> message, std::uint32_t other_run) const
{
    if (!wire::is_hello(message)) return true;
    const auto decoded = wire::decode(message);
    const auto* hello = decoded ? std::get_if<wire::Hello>(&*decoded) : nullptr;
    return hello == nullptr || (hello->nonce == other_run && hello->peer_id == other_id_);
}

void Sealed::tick(secure::Moment moment)
{
    association_.tick(moment);
    look_for_news(moment.now);
}

void Sealed::look_for_news(base::TimePoint now)
{
    const secure::Association::Counts& counts = association_.counts();
    if (counts.handshakes == before_.handshakes && counts.roamed == before_.roamed &&
        counts.other_circle == before_.other_circle)
        return;
    const bool is_new_run = counts.handshakes - counts.rekeys > before_.handshakes - before_.rekeys;
    if (is_new_run && before_.handshakes == 0) news_.put(News::sealed);
    if (is_new_run) on_restart(now);
    if (counts.rekeys > before_.rekeys) news_.put(News::rekeyed);
    if (counts.roamed > before_.roamed) news_.put(News::moved);
    if (counts.handshakes == 0 && before_.other_circle < trouble_needed &&
        counts.other_circle >= trouble_needed)
        news_.put(News::other_circle);
    before_ = counts;
}

void Sealed::on_restart(base::TimePoint now)
{
    base::TimePoint& oldest = restarts_.at(restart_count_ % restarts_.size());
    const bool is_suspect = restart_count_ >= restarts_.size() && now - oldest < restarts_within;
    if (is_suspect) news_.put(News::same_id);
    oldest = now;
    ++restart_count_;
}

std::optional<std::span<const std::byte>> Sealed::seal(std::span<const std::byte> message,
                                                       base::TimePoint now)
{
    outgoing_.assign(message);
    const auto size = association_.seal(outgoing_.room(), message.size(), now);
    if (!size) return std::nullopt;
    return std::span<const std::byte>{outgoing_.room()}.first(*size);
}

} // namespace hapnet::peer::line
