// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/monitor.hpp"

#include "proto/base/visible.hpp"
#include "proto/wire/message.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::peer::monitor {

namespace {

constexpr base::Duration on_terminal_every{std::chrono::milliseconds{200}};
constexpr base::Duration elsewhere_every{std::chrono::seconds{5}};

std::string words_on_waiting(const std::vector<std::uint16_t>& awaited, bool is_pair)
{
    if (awaited.empty()) {
        return fmt::format("agreeing on the start with the other peer{}", is_pair ? "" : "s");
    }
    if (is_pair)
        return "waiting for the other peer; is it running, and is the emulator between the two?";
    return fmt::format("waiting for peer{} {}; running, and is the emulator between you?",
                       awaited.size() == 1 ? "" : "s", fmt::join(awaited, ", "));
}

/// Adapts text about the other peer of a pair to one of several peers.
std::string with_name(std::string_view words, std::uint16_t about)
{
    std::string text{words};
    for (const std::string_view other : {"the other peer", "the other side"}) {
        for (auto at = text.find(other); at != std::string::npos; at = text.find(other, at))
            text.replace(at, other.size(), fmt::format("peer {}", about));
    }
    return text;
}

/// Returns the longest round trip in milliseconds. On one machine it takes only microseconds.
std::string longest_of(const std::map<std::uint16_t, base::Duration>& round_trips)
{
    base::Duration longest{0};
    for (const auto& [id, round_trip] : round_trips) longest = std::max(longest, round_trip);
    const double ms = base::to_seconds(longest) * 1e3;
    return ms < 1.0 ? fmt::format("{:5.3f}", ms) : fmt::format("{:5.1f}", ms);
}

std::string line_of(const StatusLine& status, const StatusLine& before, const Named& named)
{
    const record::TickRow& tick = *status.tick;
    if (const auto trouble = describe(status.sending); !trouble.empty()) {
        return fmt::format("nothing can be sent to the other peer: {}", trouble);
    }
    if (!status.session) return words_on_waiting(status.awaited, named.others.size() <= 1);
    const double at = base::to_seconds(tick.due - status.session->start);
    if (at < 0.0) return fmt::format("starts in {:.1f} s", -at);
    // The counts are per 1000 ticks of the session, which are one second.
    const auto ticks = status.ticks_in_session - before.ticks_in_session;
    const auto messages = status.messages - before.messages;
    const double rate =
        ticks == 0 ? 0.0 : 1000.0 * static_cast<double>(messages) / static_cast<double>(ticks);
    std::string phase{record::name_of(tick.phase)};
    std::replace(phase.begin(), phase.end(), '_', ' ');
    if (tick.governor == static_cast<std::uint8_t>(device::GovernorState::withheld)) {
        return fmt::format("{:5.1f} of {:.0f} s  zero force: the dead man's switch is not held, or "
                           "the force was stopped",
                           at, base::to_seconds(status.session->length));
    }
    return fmt::format("{:5.1f} of {:.0f} s  {:<9}  {} x {:+6.1f} mm  force {:4.2f} N  "
                       "received {:4.0f}/s  round trip {} ms  missed ticks {}",
                       at, base::to_seconds(status.session->length), phase, named.body,
                       tick.cube.x() * 1e3, base::norm(tick.device), rate,
                       longest_of(status.round_trips), status.missed);
}

} // namespace

std::string_view describe(net::SendOutcome outcome)
{
    switch (outcome) {
    case net::SendOutcome::sent:
    case net::SendOutcome::buffer_full: // passes soon
    // An earlier datagram was refused by the other host or this one, because no program listens
    // there yet.
    case net::SendOutcome::refused: return "";
    case net::SendOutcome::no_route: return "there is no route to it; is the network up?";
    case net::SendOutcome::too_big: return "the network takes no datagrams of this size";
    case net::SendOutcome::failed:
        return "the system refuses; can --listen reach --remote, and does a firewall allow it?";
    }
    return "";
}

std::string describe(Event event, std::string_view shared)
{
    switch (event) {
    case Event::met: return "the other peer answers";
    case Event::agreed: return "session agreed; it starts within a second";
    case Event::started: return "session started";
    case Event::joined:
        return fmt::format("joined the session under way, with {} as the other has it", shared);
    case Event::lost:
        return "the other peer has been silent for 300 ms: force faded to zero; waiting for it "
               "(is it running, and is the emulator between the two?)";
    case Event::back: return "the other peer is heard again: force ramps in";
    case Event::restarted: return "the other peer was restarted: it joins the session";
    case Event::left: return "the other peer said goodbye: going on alone, with zero force";
    case Event::refused: return "the two peers do not match: no session";
    case Event::hands_off: return "hands off";
    case Event::ended: return "session ended";
    case Event::no_body:
        return fmt::format("messages of the other peer come, but none that tells the place of {}: "
                           "something on the path drops the longer ones (136 bytes and more); the "
                           "copies will not agree",
                           shared);
    case Event::clock_jumped:
        return "clock jumped: that of the other peer's host stands elsewhere than before, as after "
               "a suspend or a move of a virtual machine; delays count anew";
    case Event::stopped: return "stopped before a session began";
    }
    return "";
}

std::string_view describe(line::News news)
{
    switch (news) {
    case line::News::sealed: return "agreed on a key with the other peer";
    case line::News::other_is_plain:
        return "the other side plays without a key, and is not heard: give it --key with its file "
               "of this circle";
    case line::News::other_is_sealed:
        return "the other side plays with a key: use --key with this host's file of its circle";
    case line::News::other_circle:
        return "handshakes come with keys that are not of this circle, and are refused: give each "
               "host its own file of one circle, never both the same, and compare the fingerprints "
               "of 'hapnet-peer key show FILE' on both hosts";
    case line::News::moved: return "the other peer is heard from another address: sending there";
    case line::News::same_id:
        return "two programs seem to play with the other peer's key and push each other out: end "
               "one of them";
    case line::News::rekeyed: return ""; // every two minutes: no news to a person
    }
    return "";
}

std::string describe_in_circle(line::News news, std::uint16_t about)
{
    return with_name(describe(news), about);
}

std::string describe_in_circle(Event event, std::string_view shared, std::uint16_t about)
{
    switch (event) {
    case Event::joined:
        return fmt::format("joined the session under way, with {} as the others have it", shared);
    case Event::lost:
        return fmt::format("peer {} has been silent for 300 ms: zero force if its hand was on {}, "
                           "until it is back or has been silent for 1 s",
                           about, shared);
    case Event::back: return fmt::format("peer {} is heard again", about);
    case Event::left: return fmt::format("peer {} said goodbye: its hand is gone", about);
    case Event::refused: return "the peers do not match: no session";
    default: return with_name(describe(event, shared), about);
    }
}

Monitor::Monitor(loop::Journal& journal, net::TextQueue& screen, Recorder::Setup recording,
                 Named named, EventLog* log)
    : journal_{journal},
      screen_{screen},
      log_{log},
      frames_{named.peer_id},
      named_{std::move(named)},
      line_{STDERR_FILENO}
{
    status_.awaited = named_.others;
    if (recording.writer || recording.held) recorder_.emplace(std::move(recording));
}

void Monitor::drain()
{
    while (const auto entry = journal_.take()) {
        if (const auto* row = std::get_if<record::Row>(&*entry)) {
            frames_.take(*row);
            take(*row);
        } else if (const auto* message = std::get_if<loop::HeardMessage>(&*entry)) {
            ++status_.messages;
            frames_.hear(message->from, message->received_at, message->message.bytes());
            note_round_trip(*message);
            if (recorder_) recorder_->put(message->row());
        } else if (const auto* event = std::get_if<loop::TimedEvent>(&*entry)) {
            on_event(*event);
        } else if (const auto* line = std::get_if<loop::TimedLineNews>(&*entry)) {
            tell({.at = line->at,
                  .name = base::name_of(line->news),
                  .about = line->about,
                  .words = is_pair() ? std::string{describe(line->news)}
                                     : describe_in_circle(line->news, line->about)});
        } else {
            const auto& timed = std::get<loop::TimedDeviceNews>(*entry);
            LoggedEvent of_device = event_of(timed);
            of_device.words = describe(timed.news);
            tell(of_device);
        }
    }
    look_at_record();
}

void Monitor::on_event(const loop::TimedEvent& event)
{
    if (event.event == Event::met) {
        std::erase_if(status_.awaited,
                      [&](std::uint16_t id) { return is_pair() || id == event.about; });
    }
    tell({.at = event.at,
          .name = name_of(event.event),
          .about = event.about,
          .words = is_pair() ? describe(event.event, named_.shared())
                             : describe_in_circle(event.event, named_.shared(), event.about)});
}

void Monitor::take(const record::Row& row)
{
    if (recorder_) recorder_->put(row);
    if (const auto* tick = std::get_if<record::TickRow>(&row)) {
        status_.tick = *tick;
        if (tick->sent_sequence > 0) ++status_.ticks_in_session;
        status_.missed += tick->missed_before;
    } else if (const auto* session = std::get_if<record::SessionRow>(&row)) {
        status_.session = *session;
    }
}

/// Notes the round trip from the echo in a message. It needs only this side's clock.
void Monitor::note_round_trip(const loop::HeardMessage& heard)
{
    const auto message = wire::decode(heard.message.bytes());
    const auto* const state = message ? std::get_if<wire::State>(&*message) : nullptr;
    if (state == nullptr || !state->echo) return;
    const base::Duration took = (heard.received_at - state->echo->of) - state->echo->age;
    if (took < base::Duration{0}) return;
    const auto [shortest, is_first] = round_trips_.try_emplace(heard.from, took);
    shortest->second = std::min(shortest->second, took);
}

/// Reports once that the record has ended early.
void Monitor::look_at_record()
{
    if (recorder_) {
        if (const auto trouble = recorder_->keep_trouble()) say(*trouble);
    }
    const auto failure = record_failure();
    if (!failure || is_failure_told_) return;
    is_failure_told_ = true;
    try {
        std::rethrow_exception(failure);
    } catch (const std::system_error& error) {
        say(fmt::format("{}: the record ends here, and the session goes on without it",
                        error.what()));
    }
}

base::Result<std::string> Monitor::keep(const std::string& name, base::TimePoint from)
{
    if (!held()) return base::fail("nothing is held in memory");
    return recorder_->keep(name, from);
}

std::exception_ptr Monitor::record_failure() const
{
    return recorder_ ? recorder_->failure() : nullptr;
}

std::uint64_t Monitor::rows_lost() const
{
    return journal_.lost() + (recorder_ ? recorder_->lost() : 0);
}

bool Monitor::is_record_whole() const
{
    return !record_failure() && rows_lost() == 0 && (!is_closed_ || is_done());
}

std::optional<base::TimePoint> Monitor::start() const
{
    return status_.session ? std::optional{status_.session->start} : std::nullopt;
}

void Monitor::note(const LoggedEvent& event)
{
    if (log_ != nullptr) log_->put(event, start());
}

void Monitor::tell(const LoggedEvent& event)
{
    if (!events_.admits(event.at)) {
        ++events_left_out_;
        return;
    }
    if (const auto left_out = std::exchange(events_left_out_, 0); left_out > 0) {
        say(fmt::format("{} messages were left out here: too many at a time", left_out));
        note({.at = event.at, .name = "left_out", .details = {{"events", left_out}}});
    }
    note(event);
    if (event.words.empty()) return;
    if (start() && event.at >= *start()) {
        say(fmt::format("{:.1f} s: {}", base::to_seconds(event.at - *start()), event.words));
    } else {
        say(event.words);
    }
}

void Monitor::say(std::string_view text)
{
    screen_.put(fmt::format("{}hapnet-peer {}: {}\n", line_.room(), named_.peer_id,
                            base::visible_lines(text)));
}

void Monitor::show(base::TimePoint now)
{
    if (!status_.tick) return;
    if (next_show_ && !base::is_due(next_show_, now)) return;
    const base::Duration every = line_.is_terminal() ? on_terminal_every : elsewhere_every;
    for (const auto& [id, shortest] : std::exchange(round_trips_, {}))
        status_.round_trips[id] = shortest;
    if (next_show_ || line_.is_terminal()) {
        const std::string line = line_of(status_, shown_, named_);
        if (line_.is_terminal()) {
            screen_.put(line_.shown(fmt::format("hapnet-peer {}: {}", named_.peer_id, line)));
        } else {
            say(line);
        }
    }
    shown_ = status_;
    next_show_ = now + every;
}

void Monitor::close()
{
    drain();
    if (recorder_) recorder_->close();
    is_closed_ = true;
}

void Monitor::finish()
{
    look_at_record();
    if (events_left_out_ > 0) {
        say(fmt::format("{} more messages were left out: too many at a time", events_left_out_));
    }
    screen_.put(line_.left());
}

} // namespace hapnet::peer::monitor
