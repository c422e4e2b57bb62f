// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/frames.hpp"

#include "emulator/core/too_big.hpp"
#include "emulator/ports/batch.hpp"
#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/interface.hpp"

#include <algorithm>
#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <vector>

namespace hapnet::emulator::ports {

namespace {

DropCause frame_cause_of(net::SendOutcome outcome)
{
    switch (outcome) {
    case net::SendOutcome::buffer_full: return DropCause::send_buffer_full;
    case net::SendOutcome::no_route: return DropCause::no_route;
    case net::SendOutcome::too_big: return DropCause::too_big;
    case net::SendOutcome::sent:
    case net::SendOutcome::refused:
    case net::SendOutcome::failed: break;
    }
    return DropCause::send_failed;
}

/// The laws know payloads, and add IP and UDP headers where those count (Mtu, Rate). So that they
/// find the size of the IP packet, as much of it belongs to the envelope.
std::uint8_t envelope_of(const Frame& frame, std::size_t frame_bytes)
{
    return static_cast<std::uint8_t>(std::min(frame.header_bytes + Mtu::header_bytes, frame_bytes));
}

std::size_t place_of(const MacAddress& address)
{
    std::size_t hash = 0;
    for (const std::byte byte : address) hash = hash * 31 + std::to_integer<std::size_t>(byte);
    return hash % 1024;
}

/// An address that several machines may use.
bool is_group(const MacAddress& address) { return (address[0] & std::byte{1}) != std::byte{0}; }

} // namespace

class Frames::Outgoing {
public:
    Outgoing(Frames& frames, Direction direction, Side& to)
        : frames_{frames}, direction_{direction}, to_{to}
    {}

    void add(EmulatedPath& path, const Datagram& departure)
    {
        paths_[count_] = &path;
        departures_[count_] = departure;
        add_bytes(departure.bytes);
    }
    /// A frame that the conditions do not hold for.
    void add_undisturbed(std::span<const std::byte> bytes)
    {
        departures_[count_].reset();
        add_bytes(bytes);
    }

    void flush()
    {
        if (count_ == 0) return;
        const auto outcomes = to_.socket.send_batch({bytes_.data(), count_});
        const auto at = net::monotonic_now();
        for (std::size_t i = 0; i < count_; ++i) {
            const bool is_sent = outcomes[i] == net::SendOutcome::sent;
            if (!departures_[i]) {
                if (!is_sent) ++to_.lost_undisturbed;
            } else if (is_sent) {
                paths_[i]->on_sent(direction_, *departures_[i], at);
            } else {
                paths_[i]->on_failed(direction_, *departures_[i], frame_cause_of(outcomes[i]));
            }
        }
        count_ = 0;
        fixed_.clear();
    }

private:
    void add_bytes(std::span<const std::byte> bytes)
    {
        const auto& departure = departures_[count_];
        const bool is_to_be_marked =
            departure && departure->marks.is_congested() && !read_frame(bytes).marks.is_congested();
        if (departure && (frames_.setup_.fix_checksums || is_to_be_marked)) {
            fixed_.emplace_back(bytes.begin(), bytes.end());
            if (is_to_be_marked) mark_congestion(fixed_.back());
            if (frames_.setup_.fix_checksums) fix_checksums(fixed_.back());
            bytes = fixed_.back();
        }
        bytes_[count_] = bytes;
        ++count_;
        if (count_ == bytes_.size()) flush();
    }

    Frames& frames_;
    Direction direction_;
    Side& to_;
    std::size_t count_ = 0;
    std::array<EmulatedPath*, net::PacketSocket::batch_max> paths_{}; // of the departures
    std::array<std::optional<Datagram>, net::PacketSocket::batch_max> departures_{};
    std::array<std::span<const std::byte>, net::PacketSocket::batch_max> bytes_{};
    std::vector<std::vector<std::byte>> fixed_; // copies that are changed on the way out
};

Frames::Side::Side(Direction from_here, const std::string& name) : direction{from_here}, interface {
    name
}, socket{name}, frame_bytes_max{net::mtu_of(name) + Frame::header_bytes_min} {}

Frames::Frames(const Setup& setup, Paths& paths, Recorder& recorder)
    : setup_{setup},
      paths_{paths},
      path_{paths.add("")},
      recorder_{recorder.lane()},
      recorded_as_{add_to(recorder, "", paths.flows())},
      a_{Direction::up, setup.interface_a},
      b_{Direction::down, setup.interface_b}
{}

void Frames::receive()
{
    pass(a_, b_);
    pass(b_, a_);
    watch_interface(a_);
    watch_interface(b_);
}

/// Without one of the interfaces nothing passes, and the run says nothing about its conditions.
void Frames::watch_interface(const Side& side)
{
    if (side.socket.error() == 0 || is_end_expected_ || failure_) return;
    const auto& name = side.interface;
    failure_ = net::has_interface(name)
                   ? fmt::format("the interface {0} is down, so nothing passes: set it up (ip link "
                                 "set {0} up), and start again",
                                 name)
                   : fmt::format("the interface {} has gone, so nothing passes: make it again, "
                                 "and start again",
                                 name);
}

void Frames::pass(Side& from, Side& to)
{
    const auto arrived = from.socket.receive();
    if (arrived.empty()) return;
    Outgoing undelayed{*this, from.direction, to};
    for (const net::ReceivedFrame& received : arrived) {
        const Frame frame = read_frame(received.bytes);
        arrival_ = received.at;
        if (setup_.stops_at_loop) watch_for_loop(from, frame);
        if (received.lacks_checksum) fix_checksums(received.bytes);
        if (frame.kind != FrameKind::ip) ++from.not_ip;
        if (says_port_unreachable(frame, received.bytes)) ++from.unreachable;
        const auto tags = frame.header_bytes - std::min(frame.header_bytes, std::uint8_t{14});
        if (received.bytes.size() > from.frame_bytes_max + static_cast<std::size_t>(tags)) {
            ++from.oversized;
        }
        const bool is_disturbed = frame.kind == FrameKind::ip || setup_.all_frames;
        if (!is_disturbed) {
            ++from.undisturbed;
            undelayed.add_undisturbed(received.bytes);
            continue;
        }
        paths_.advance(received.at);
        EmulatedPath* path = &path_;
        std::uint32_t recorded_as = recorded_as_;
        base::TimePoint at = received.at;
        if (Branches* branches = path_.branches()) {
            at = branches->in_order(from.direction, at);
            if (const auto flow = branches->flow_of(facts_of(frame, received.bytes), at)) {
                path = branches->paths()[*flow];
                recorded_as += static_cast<std::uint32_t>(*flow + 1);
            }
        }
        const Admission admission = path->on_packet(
            from.direction, received.bytes, at, true,
            {.envelope_bytes = envelope_of(frame, received.bytes.size()), .marks = frame.marks});
        recorder_.on_fate(recorded_as, from.direction, admission.number, admission.fate);
        if (admission.departure) undelayed.add(*path, *admission.departure);
        if (setup_.answers_too_big && admission.drop == DropCause::mtu) {
            answer_too_big(from, *path, received.bytes);
        }
    }
    undelayed.flush();
    if (from.oversized > 0 && !std::exchange(has_told_of_oversized_, true)) {
        const auto& cure = setup_.cure_of_oversized;
        untold_ =
            fmt::format("{} hands over packets that are longer than its MTU: {}", from.interface,
                        cure.empty() ? fmt::format("it puts segments together. Switch that "
                                                   "off: ethtool -K {} gro off lro off",
                                                   from.interface)
                                     : cure);
    }
}

/// At once, as if the router were the emulator's interface.
void Frames::answer_too_big(Side& from, const EmulatedPath& path, std::span<const std::byte> frame)
{
    const auto mtu = path.link(from.direction).conditions().mtu.bytes_max;
    const auto answer = too_big_answer(frame, mtu);
    if (answer.empty()) return;
    const std::array<std::span<const std::byte>, 1> batch{answer};
    if (from.socket.send_batch(batch).front() == net::SendOutcome::sent) ++from.told_too_big;
}

/// A machine that moves from one side to the other again and again stands behind both: frames would
/// go round for ever.
void Frames::watch_for_loop(const Side& from, const Frame& frame)
{
    constexpr base::Duration recent = std::chrono::seconds{1};
    constexpr unsigned moves_max = 5;
    if (frame.header_bytes < Frame::header_bytes_min || is_group(frame.source)) return;
    Heard& heard = heard_[place_of(frame.source)];
    if (heard.who != frame.source || arrival_ - heard.at > recent) {
        heard = {frame.source, from.direction, arrival_, 0};
        return;
    }
    heard.at = arrival_;
    if (std::exchange(heard.direction, from.direction) == from.direction) return;
    if (++heard.moves < moves_max || failure_) return;
    std::string address;
    for (const std::byte byte : frame.source) {
        address +=
            fmt::format("{}{:02x}", address.empty() ? "" : ":", std::to_integer<unsigned>(byte));
    }
    failure_ =
        fmt::format("a loop: {} sends on {} and on {}, so the two are joined elsewhere, too. "
                    "Take the other way between them away, and start again",
                    address, a_.interface, b_.interface);
}

bool Frames::send_due(EmulatedPath& path, Direction direction, base::TimePoint now)
{
    if (!base::is_due(path.link(direction).next_deadline(), now)) return false;
    Outgoing due{*this, direction, direction == Direction::up ? b_ : a_};
    for (std::size_t i = 0; i < net::PacketSocket::batch_max; ++i) {
        const auto departure = path.poll(direction, now);
        if (!departure) {
            due.flush();
            return false;
        }
        due.add(path, *departure);
    }
    return true;
}

void Frames::release(base::TimePoint now)
{
    paths_.each_due(now, [&](std::size_t number) { release(paths_.at(number), now); });
}

void Frames::release(EmulatedPath& path, base::TimePoint now)
{
    bool up_has_more = true;
    bool down_has_more = true;
    for (int round = 0; round < release_rounds_max && (up_has_more || down_has_more); ++round) {
        if (up_has_more) up_has_more = send_due(path, Direction::up, now);
        if (down_has_more) down_has_more = send_due(path, Direction::down, now);
    }
}

std::optional<std::string> Frames::next_notice() { return std::exchange(untold_, std::nullopt); }

} // namespace hapnet::emulator::ports
