// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/association.hpp"

#include "proto/base/bytes.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

namespace hapnet::secure {

namespace {

using base::ByteReader;
using base::ByteWriter;

/// Returns the facts on which both sides of a handshake must agree.
std::array<std::byte, 18> prologue_of(const Association::Config& config)
{
    constexpr std::string_view protocol = "hapnet 2";
    std::array<std::byte, 18> prologue{};
    ByteWriter out{prologue};
    out.raw(std::as_bytes(std::span{protocol}));
    out.raw(config.circle);
    out.u8(std::min(config.own_id, config.other_id));
    out.u8(std::max(config.own_id, config.other_id));
    return prologue;
}

Mac mac_of(Bytes bytes)
{
    Mac mac{};
    std::ranges::copy(bytes, mac.begin());
    return mac;
}

constexpr std::size_t type_place = 3, session_place = 4;
constexpr std::byte plain_hello{1}, plain_state_type{2};

} // namespace

Association::Responding::Responding(KeyIndex own_index, const WaitingInitiation& initiation,
                                    const StaticKeys& keys, Bytes prologue, Secret ephemeral)
    : own{own_index},
      other{initiation.sender},
      noise{Role::responder, keys, prologue, std::move(ephemeral)},
      cause{initiation.cause},
      to{initiation.from}
{}

Association::Association(const Config& config, StaticKeys keys, Secret seed)
    : config_{config},
      keys_{std::move(keys)},
      entropy_{std::move(seed)},
      prologue_{prologue_of(config)},
      other_mac1_key_{key_of_mac1(keys_, keys_.other())},
      door_{key_of_mac1(keys_, keys_.own_public()), entropy_.secret()},
      cookies_{other_mac1_key_},
      place_{config.place}
{
    base::ensure(config.own_id != config.other_id && config.run != 0);
    base::ensure(config.session_of != nullptr);
}

std::uint32_t Association::session_with(std::uint32_t other_run) const
{
    return is_lower() ? config_.session_of(config_.run, other_run)
                      : config_.session_of(other_run, config_.run);
}

/// Returns an index that is not used for anything else on this side.
KeyIndex Association::fresh_index()
{
    for (;;) {
        const KeyIndex index = drawn();
        const bool is_taken = epoch_of(index) != nullptr ||
                              (initiating_ && initiating_->own == index) ||
                              (responding_ && responding_->own == index);
        if (index != 0 && !is_taken) return index;
    }
}

std::uint32_t Association::drawn()
{
    const auto bytes = entropy_.bytes<4>();
    return ByteReader{bytes}.u32();
}

const Association::Epoch* Association::epoch_of(KeyIndex index) const
{
    for (const auto* epoch : {&current_, &next_, &previous_})
        if (*epoch && (*epoch)->own == index) return &**epoch;
    return nullptr;
}

Association::Epoch* Association::epoch_of(KeyIndex index)
{
    return const_cast<Epoch*>(std::as_const(*this).epoch_of(index)); // NOLINT(*-const-cast)
}

Association::Counts& Association::Counts::operator+=(const Counts& other)
{
    for (const auto count :
         {&Counts::handshakes, &Counts::rekeys, &Counts::forged, &Counts::replayed,
          &Counts::unsealed, &Counts::unknown_key, &Counts::other_circle, &Counts::refused,
          &Counts::unread, &Counts::cookies, &Counts::roamed, &Counts::not_sealed})
        this->*count += other.*count;
    last_handshake = std::max(last_handshake, other.last_handshake);
    return *this;
}

// --- received messages ---

bool Association::is_named_by(Bytes datagram) const
{
    const auto is_handshake = [this](KeyIndex index) {
        return initiating_ && initiating_->own == index;
    };
    if (const auto index = key_of(datagram)) return epoch_of(*index) != nullptr;
    if (const auto initiation = read_initiation(datagram))
        return initiation->ends == Ends{config_.other_id, config_.own_id};
    if (const auto response = read_response(datagram)) return is_handshake(response->receiver);
    const auto cookie = read_cookie_reply(datagram);
    return cookie && is_handshake(cookie->receiver);
}

std::optional<Association::Received>
Association::on_datagram(std::span<std::byte> datagram, const Place& from, base::TimePoint now)
{
    const auto type = frame_type_of(datagram);
    if (!type) {
        ++counts_.unsealed;
        return std::nullopt;
    }
    switch (*type) {
    case FrameType::initiation: on_initiation(datagram, from, now); return std::nullopt;
    case FrameType::response: on_response(datagram, from); return std::nullopt;
    case FrameType::cookie: on_cookie_reply(datagram, now); return std::nullopt;
    case FrameType::hello:
    case FrameType::state:
    case FrameType::bye: break;
    }
    const auto index = key_of(datagram);
    if (!index) {
        ++counts_.unsealed;
        return std::nullopt;
    }
    return on_message(datagram, *index, from, now);
}

std::optional<Association::Received> Association::on_message(std::span<std::byte> datagram,
                                                             KeyIndex index, const Place& from,
                                                             base::TimePoint now)
{
    if (previous_ && now >= previous_until_) previous_.reset();
    Epoch* epoch = epoch_of(index);
    if (epoch == nullptr) {
        ++counts_.unknown_key;
        return std::nullopt;
    }
    const OpenedFrame opened = open_frame(datagram, epoch->opener);
    if (opened.outcome == Opener::Outcome::forged) ++counts_.forged;
    if (opened.outcome == Opener::Outcome::replayed) ++counts_.replayed;
    if (opened.size == 0) return std::nullopt;
    last_opened_ = now;
    if (current_ && epoch == &*current_) confirm_at_.reset();
    if (next_ && epoch == &*next_) { // the other side uses the next key: use it, too
        dates_.confirm(next_date_);
        use(std::move(*std::exchange(next_, std::nullopt)), now);
        epoch = &*current_;
        answered_.reset(); // the answer has arrived
    }
    // A state shows the present place of the other side. Until a state arrives under this key,
    // other messages show it, because a peer that is restarted at another place first sends hellos.
    epoch->has_opened_state = epoch->has_opened_state || opened.is_state;
    const bool is_newest = opened.outcome == Opener::Outcome::opened_newest &&
                           (opened.is_state || !epoch->has_opened_state);
    const bool has_moved = is_newest && epoch == &*current_ && config_.may_roam;
    if (!place_ || has_moved) move_to(from);
    if (opened.size == empty_bytes) return std::nullopt;
    if (datagram[type_place] != plain_hello)
        ByteWriter{datagram.subspan(session_place, 4)}.u32(epoch->session);
    return Received{opened.size, epoch->other_run};
}

void Association::move_to(const Place& place)
{
    if (place_ && *place_ != place) ++counts_.roamed;
    place_ = place;
}

void Association::on_initiation(Bytes datagram, const Place& from, base::TimePoint now)
{
    const auto initiation = read_initiation(datagram);
    const Ends expected{config_.other_id, config_.own_id};
    if (!initiation || initiation->ends != expected ||
        !door_.knows_us(initiation->macs.covered_by_mac1, initiation->macs.mac1)) {
        ++counts_.other_circle;
        return;
    }
    const Mac cause = mac_of(initiation->macs.mac1);
    const Place answer_to = answer_place(from);
    if (answered_ && answered_->cause == cause) {
        ++counts_.unread;
        answered_->to = answer_to;
        return send_answer(now);
    }
    const bool is_known =
        (responding_ && responding_->cause == cause) ||
        initiations_.find([&](const auto& one) { return one.cause == cause; }) != nullptr;
    if (is_known || (initiating_ && is_lower())) { // the other side answers this side's initiation
        ++counts_.unread;
        return;
    }
    if (!door_.lets_in(*initiation, from, now)) {
        ++counts_.cookies;
        return send(door_.cookie_reply(*initiation, from, now), answer_to);
    }
    WaitingInitiation waiting{initiation->sender, cause, {}, answer_to};
    std::ranges::copy(initiation->noise, waiting.noise.begin());
    if (!initiations_.add(waiting, drawn())) ++counts_.unread;
}

/// Returns the place to which the answer to a handshake message from `from` is sent. The sender is
/// not authenticated yet. So if the other side may not roam, the answer goes to its configured
/// place, if it has one.
Place Association::answer_place(const Place& from) const
{
    return config_.may_roam || !place_ ? from : *place_;
}

void Association::on_response(Bytes datagram, const Place& from)
{
    const auto response = read_response(datagram);
    if (!response || !door_.knows_us(response->macs.covered_by_mac1, response->macs.mac1)) {
        ++counts_.other_circle;
        return;
    }
    if (!initiating_ || !initiating_->frame || response->receiver != initiating_->own) {
        ++counts_.unread;
        return;
    }
    WaitingResponse waiting{response->sender, {}, from};
    std::ranges::copy(response->noise, waiting.noise.begin());
    if (!initiating_->responses.add(waiting, drawn())) ++counts_.unread;
}

void Association::on_cookie_reply(Bytes datagram, base::TimePoint now)
{
    const auto reply = read_cookie_reply(datagram);
    const bool is_for_us = reply && initiating_ && initiating_->frame &&
                           reply->receiver == initiating_->own &&
                           cookies_.take(*reply, initiating_->frame->mac1(), now);
    if (!is_for_us) {
        ++counts_.other_circle;
        return;
    }
    initiating_->frame->set_macs(other_mac1_key_, cookies_.cookie(now));
    initiating_->has_new_cookie = true;
}

// --- due work ---

void Association::tick(Moment moment)
{
    const bool may_respond = responding_ || !initiations_.is_empty();
    const bool may_initiate = initiating_ && initiating_->has_work();
    // Initiating and responding take turns, so that a flood of one kind does not block the other.
    if (may_initiate && (!may_respond || is_turn_to_initiate_)) {
        step_initiation(moment);
        is_turn_to_initiate_ = false;
    } else if (may_respond) {
        step_response(moment.now);
        is_turn_to_initiate_ = true;
    }
    if (!initiating_ && !responding_ && needs_key(moment.now)) begin(moment);
    repeat(moment.now);
}

bool Association::needs_key(base::TimePoint now) const
{
    if (now < listens_until_) return false;
    if (waits_for_confirmation(now)) return false;
    if (!current_) return true;
    const base::Duration lasts = rekey_after + (is_lower() ? -rekey_spread : rekey_spread);
    return now - current_->made >= lasts || now - last_opened_ >= silence;
}

/// True if an answer of this side may still be confirmed by the other side. This side waits for it
/// only once, because otherwise someone who replays recorded initiations could prevent it from ever
/// initiating.
bool Association::waits_for_confirmation(base::TimePoint now) const
{
    return unconfirmed_since_ && now - *unconfirmed_since_ < fresh_after;
}

/// Returns the date of the next initiation. It increases within a run even if the clock is set
/// back, because the other side refuses dates older than those of this run's earlier initiations.
std::int64_t Association::date(Moment moment)
{
    if (own_date_ < std::numeric_limits<std::int64_t>::max()) ++own_date_;
    return own_date_ = std::max(own_date_, moment.unix_ns);
}

void Association::begin(Moment moment)
{
    if (!place_) return;
    if (is_lower()) { // the other side answers this side's initiation
        counts_.unread += initiations_.size();
        initiations_.clear();
    }
    if (!unanswered_since_) unanswered_since_ = moment.now;
    initiating_.emplace(fresh_index(), keys_, prologue_, entropy_.secret(), moment.now);
    std::array<std::byte, initiation_payload_bytes> payload{};
    ByteWriter out{payload};
    out.i64(date(moment));
    out.u32(config_.run);
    out.u32(0);
    initiating_->noise.write(payload);
}

void Association::end_initiating()
{
    if (initiating_) counts_.unread += initiating_->responses.size();
    initiating_.reset();
}

void Association::read_next_response()
{
    const WaitingResponse next = initiating_->responses.take();
    initiating_->other = next.sender;
    initiating_->answered_from = next.from;
    initiating_->noise.read(next.noise);
}

void Association::step_initiation(Moment moment)
{
    Initiating& own = *initiating_;
    if (own.frame && !own.other) read_next_response();
    const auto progress = own.noise.step();
    if (progress == NoiseKk::Progress::working) return;
    if (progress == NoiseKk::Progress::refused) {
        ++counts_.refused;
        own.other.reset(); // the genuine response may still come
        return;
    }
    if (!own.frame) {
        own.frame = HandshakeFrame::initiation(own.own, {config_.own_id, config_.other_id},
                                               own.noise.message());
        own.frame->set_macs(other_mac1_key_, cookies_.cookie(moment.now));
        return;
    }
    const std::uint32_t other_run = ByteReader{own.noise.payload()}.u32();
    if (other_run == 0) {
        ++counts_.refused;
        end_initiating();
        return;
    }
    counts_.last_handshake = moment.now - unanswered_since_.value_or(own.began);
    Epoch made{own.own,   *own.other, own.noise.split(), other_run, session_with(other_run),
               moment.now};
    if (config_.may_roam) move_to(own.answered_from);
    next_.reset();
    last_opened_ = moment.now;
    use(std::move(made), moment.now);
    confirm_at_ = moment.now;
}

void Association::use(Epoch epoch, base::TimePoint now)
{
    ++counts_.handshakes;
    unconfirmed_since_.reset();
    unanswered_since_.reset();
    end_initiating();
    previous_.reset();
    if (current_ && current_->other_run == epoch.other_run) {
        ++counts_.rekeys;
        previous_.emplace(std::move(*current_));
        previous_until_ = now + previous_lasts;
    } else { // messages of the former run come too late
        run_since_ = now;
    }
    current_.emplace(std::move(epoch));
}

void Association::read_next_initiation()
{
    const WaitingInitiation next = initiations_.take();
    responding_.emplace(fresh_index(), next, keys_, prologue_, entropy_.secret());
    responding_->noise.read(next.noise);
}

void Association::step_response(base::TimePoint now)
{
    if (!responding_) read_next_initiation();
    const auto progress = responding_->noise.step();
    if (progress == NoiseKk::Progress::working) return;
    if (progress == NoiseKk::Progress::refused) ++counts_.refused;
    const bool goes_on =
        progress == NoiseKk::Progress::done && (responding_->is_writing || take_initiation(now));
    if (!goes_on) {
        responding_.reset();
        return;
    }
    if (responding_->is_writing) return answer(now);
    responding_->is_writing = true;
    std::array<std::byte, response_payload_bytes> payload{};
    ByteWriter{payload}.u32(config_.run);
    responding_->noise.write(payload);
}

/// True if another run than the one that is heard begins too soon after the last change. Without
/// this check, two programs with one key would displace each other forever. A run that has fallen
/// silent may be replaced at once.
bool Association::pushes_another_out(base::TimePoint now) const
{
    return current_ && responding_->other_run != current_->other_run &&
           now - run_since_ < runs_change_every && now - last_opened_ < silence;
}

/// True if an initiation that is proven to be from the other side is also new.
bool Association::take_initiation(base::TimePoint now)
{
    ByteReader in{responding_->noise.payload()};
    responding_->date = in.i64();
    responding_->other_run = in.u32();
    const bool is_canonical = in.u32() == 0 && in.complete() && responding_->other_run != 0;
    if (!is_canonical) {
        ++counts_.refused;
        return false;
    }
    if (pushes_another_out(now)) {
        ++counts_.refused;
        return false;
    }
    if (!dates_.take(responding_->other_run, responding_->date, now)) {
        ++counts_.replayed;
        return false;
    }
    return true;
}

void Association::answer(base::TimePoint now)
{
    Responding& own = *responding_;
    HandshakeFrame frame = HandshakeFrame::response(own.other, own.own, own.noise.message());
    frame.set_macs(other_mac1_key_, cookies_.cookie(now));
    next_.reset();
    next_.emplace(own.own, own.other, own.noise.split(), own.other_run, session_with(own.other_run),
                  now);
    next_date_ = own.date;
    answered_ = Answer{.frame = frame, .cause = own.cause, .to = own.to};
    send_answer(now);
    responding_.reset();
    if (!unconfirmed_since_) unconfirmed_since_ = now;
    if (!waits_for_confirmation(now)) return; // this side's own handshake continues
    end_initiating();                         // the other side's handshake is further
    confirm_at_.reset();
    unanswered_since_.reset();
}

/// Sends an answer. Three answers have at most three times as many bytes as the initiation.
void Association::send_answer(base::TimePoint now)
{
    answered_->repeats_left = response_repeats;
    answered_->repeat_at = now + repeat_every;
    send(answered_->frame, answered_->to);
}

void Association::repeat_answer(base::TimePoint now)
{
    if (!answered_ || answered_->repeats_left == 0 || now < answered_->repeat_at) return;
    --answered_->repeats_left;
    answered_->repeat_at = now + repeat_every;
    send(answered_->frame, answered_->to);
}

/// Sends confirmations until the other side is heard under the key that this side began. The other
/// side does not use that key before it has received a message under it, and this side may have no
/// messages of its own.
void Association::confirm(base::TimePoint now)
{
    if (!confirm_at_ || now < *confirm_at_ || !place_) return;
    std::array<std::byte, empty_bytes + control_overhead> room{};
    ByteWriter out{room};
    out.u16(magic);
    out.u8(version);
    out.u8(std::to_integer<std::uint8_t>(plain_hello));
    if (const auto size = seal(room, empty_bytes, now))
        send(HandshakeFrame::confirmation(Bytes{room}.first(*size)), *place_);
    confirm_at_ = now + repeat_every;
}

void Association::repeat(base::TimePoint now)
{
    repeat_answer(now);
    confirm(now);
    if (!initiating_ || !initiating_->frame) return;
    if (now - initiating_->began >= fresh_after) {
        // The lower id listens for a while, because the other side may be able to reach this one.
        if (is_lower()) listens_until_ = now + listen_for;
        end_initiating();
        return;
    }
    const bool is_slow = now - unanswered_since_.value_or(now) >= repeat_slowly_after &&
                         !initiating_->has_new_cookie;
    const base::Duration every = is_slow ? repeat_slowly_every : repeat_every;
    if (initiating_->last_sent && now - *initiating_->last_sent < every) return;
    initiating_->last_sent = now;
    initiating_->has_new_cookie = false;
    if (place_) send(*initiating_->frame, *place_);
    // An attacker on the path may have made both sides send to wrong places.
    if (config_.place && config_.place != place_) send(*initiating_->frame, *config_.place);
}

// --- messages to send ---

void Association::send(const HandshakeFrame& frame, const Place& to)
{
    if (outgoing_count_ < outgoing_.size()) outgoing_[outgoing_count_++] = {frame, to};
}

std::optional<Association::Outgoing> Association::poll()
{
    if (outgoing_count_ == 0) return std::nullopt;
    const Outgoing first = outgoing_.front();
    std::copy(outgoing_.begin() + 1,
              outgoing_.begin() + static_cast<std::ptrdiff_t>(outgoing_count_), outgoing_.begin());
    --outgoing_count_;
    return first;
}

bool Association::has_key(base::TimePoint now) const
{
    return current_ && now - current_->made < key_lasts;
}

std::optional<base::Duration> Association::key_age(base::TimePoint now) const
{
    if (!current_) return std::nullopt;
    return now - current_->made;
}

std::optional<std::size_t> Association::seal(std::span<std::byte> room, std::size_t size,
                                             base::TimePoint now)
{
    const auto sealed = [&]() -> std::optional<std::size_t> {
        if (!has_key(now) || size < session_place + 4) return std::nullopt;
        Epoch& epoch = *current_;
        if (room[type_place] == plain_state_type) {
            if (size < state_head_bytes) return std::nullopt;
            ByteReader in{Bytes{room}.subspan(session_place)};
            const bool is_of_session = in.u32() == epoch.session;
            if (!is_of_session || !epoch.sealer.may_seal(Kind::state, in.u32()))
                return std::nullopt;
            return seal_frame(room, size, epoch.other, 0, epoch.sealer);
        }
        if (!epoch.sealer.may_seal(Kind::control, epoch.controls + 1)) return std::nullopt;
        return seal_frame(room, size, epoch.other, ++epoch.controls, epoch.sealer);
    }();
    if (!sealed) ++counts_.not_sealed;
    return sealed;
}

} // namespace hapnet::secure
