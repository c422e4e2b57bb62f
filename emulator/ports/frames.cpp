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

namespace hapnet::emulator::ports {

namespace {

/// Returns the length of the envelope. The laws use payload sizes, and add IP and UDP headers where
/// those count (Mtu, Rate). For them to compute the size of the IP packet, the envelope includes as
/// many bytes of the packet as these headers have.
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

/// True for an address that several machines may use.
bool is_group(const MacAddress& address) { return (address[0] & std::byte{1}) != std::byte{0}; }

} // namespace

std::vector<std::string> Frames::Setup::path_names() const
{
    if (ends.size() == 2) return {""};
    std::vector<std::string> names;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        for (std::size_t j = i + 1; j < ends.size(); ++j) {
            names.push_back(fmt::format("{}-{}", ends[i].name, ends[j].name));
        }
    }
    return names;
}

Frames::End::End(const Place& place, Recorder::Lane& recorder, bool fixes_checksums)
    : name{place.name}, interface {
    place.interface
}, machine{place.machine}, socket{interface}, leaving{socket, recorder, fixes_checksums},
    frame_bytes_max{net::mtu_of(interface) + Frame::header_bytes_min}
{}

Frames::Frames(const Setup& setup, Paths& paths, Recorder& recorder)
    : setup_{setup}, paths_{paths}, recorder_{recorder.lane()}
{
    base::ensure(setup_.ends.size() >= 2);
    for (const Place& place : setup_.ends) {
        ends_.emplace_back(place, recorder_, setup_.fix_checksums);
    }
    const auto names = setup_.path_names();
    for (std::size_t a = 0; a < ends_.size(); ++a) {
        for (std::size_t b = a + 1; b < ends_.size(); ++b) {
            const std::string& name = names[pairs_.size()];
            const auto number = static_cast<std::uint32_t>(pairs_.size());
            const auto recorded_as = add_to(recorder, name, paths.flows());
            Pair& pair =
                pairs_.emplace_back(Pair{name, paths.add(name), a, b, number, recorded_as});
            put_by_number(by_path_, pair.path, &pair);
        }
    }
}

/// Returns the pair of two ends. The pairs are ordered by their first ends, and then by their
/// second ones.
Frames::Pair& Frames::pair_of(std::size_t one, std::size_t other)
{
    const auto [a, b] = std::minmax(one, other);
    return pairs_[a * (2 * ends_.size() - a - 1) / 2 + b - a - 1];
}

void Frames::receive()
{
    for (std::size_t i = 0; i < ends_.size(); ++i) pass(i);
    for (const End& end : ends_) watch_interface(end);
}

/// Stops the run if the interface is lost: without it no frame passes, and the run does not
/// represent its conditions.
void Frames::watch_interface(const End& end)
{
    if (end.socket.error() == 0 || is_end_expected_ || failure_) return;
    const auto& name = end.interface;
    failure_ = net::has_interface(name)
                   ? fmt::format("the interface {0} is down, so nothing passes: set it up (ip link "
                                 "set {0} up), and start again",
                                 name)
                   : fmt::format("the interface {} has gone, so nothing passes: make it again, "
                                 "and start again",
                                 name);
}

/// Returns the end of the machine that the frame is for; nullopt: the frame is for a group, or the
/// machine is not known.
std::optional<std::size_t> Frames::end_of(std::span<const std::byte> frame) const
{
    const auto machine = destination_of(frame);
    if (!machine) return std::nullopt;
    for (std::size_t i = 0; i < ends_.size(); ++i) {
        if (ends_[i].machine == machine) return i;
    }
    return std::nullopt;
}

void Frames::pass(std::size_t from)
{
    End& end = ends_[from];
    const auto arrived = end.socket.receive();
    if (arrived.empty()) return;
    for (const net::ReceivedFrame& received : arrived) {
        const Frame frame = read_frame(received.bytes);
        arrival_ = received.at;
        if (setup_.stops_at_loop) watch_for_loop(from, frame);
        if (received.lacks_checksum) fix_checksums(received.bytes);
        count(end, received, frame);
        const auto to = end_of(received.bytes);
        if (to && *to != from) {
            pass(from, *to, received, frame);
            continue;
        }
        for (std::size_t other = 0; other < ends_.size(); ++other) {
            if (other != from) pass(from, other, received, frame);
        }
    }
    send_leaving();
    tell_of_oversized(end);
}

void Frames::count(End& from, const net::ReceivedFrame& received, const Frame& frame)
{
    if (frame.kind != FrameKind::ip) ++from.not_ip;
    if (frame.kind != FrameKind::ip && !setup_.all_frames) ++from.undisturbed;
    const auto tags = frame.header_bytes - std::min(frame.header_bytes, std::uint8_t{14});
    if (received.bytes.size() > from.frame_bytes_max + static_cast<std::size_t>(tags)) {
        ++from.oversized;
    }
}

/// Sends the frames that are not delayed. Call it while the bytes that arrived are valid, because
/// the frames refer to them.
void Frames::send_leaving()
{
    for (End& end : ends_) end.leaving.flush();
}

void Frames::pass(std::size_t from, std::size_t to, const net::ReceivedFrame& received,
                  const Frame& frame)
{
    FrameBatch& leaving = ends_[to].leaving;
    if (frame.kind != FrameKind::ip && !setup_.all_frames) {
        return leaving.add_undisturbed(received.bytes, ends_[from].lost_undisturbed);
    }
    Pair& pair = pair_of(from, to);
    const Direction direction = from < to ? Direction::up : Direction::down;
    if (says_port_unreachable(frame, received.bytes)) {
        ++(direction == Direction::up ? pair.unreachable_down : pair.unreachable_up);
    }
    paths_.advance(received.at);
    EmulatedPath* path = &pair.path;
    std::uint32_t recorded_as = pair.recorded_as;
    base::TimePoint at = received.at;
    if (Branches* branches = path->branches()) {
        at = branches->in_order(direction, at);
        if (const auto flow = branches->flow_of(facts_of(frame, received.bytes), at)) {
            path = branches->paths()[*flow];
            recorded_as += static_cast<std::uint32_t>(*flow + 1);
        }
    }
    const Admission admission = path->on_packet(
        direction, received.bytes, at, true,
        {.envelope_bytes = envelope_of(frame, received.bytes.size()), .marks = frame.marks});
    recorder_.on_fate(recorded_as, direction, admission.number, admission.fate);
    if (recorder_.captures()) {
        Fate fate = admission.fate;
        fate.drop = admission.drop;
        const auto packet = ip_packet_of(received.bytes);
        if (!packet.empty()) {
            recorder_.on_arrival(
                {.side = direction == Direction::up ? CaptureSide::a : CaptureSide::b,
                 .is_outbound = false,
                 .at = received.at,
                 .payload = packet,
                 .pair = pair.number,
                 .is_ip = true},
                fate);
        }
    }
    if (admission.departure) {
        leaving.add({path, direction, pair.number}, *admission.departure);
    } else if (setup_.answers_too_big && admission.drop == DropCause::mtu) {
        answer_too_big(ends_[from], path->link(direction).conditions().mtu.bytes_max,
                       received.bytes);
    }
}

void Frames::tell_of_oversized(const End& from)
{
    if (from.oversized == 0 || std::exchange(has_told_of_oversized_, true)) return;
    const auto& cure = setup_.cure_of_oversized;
    untold_ = fmt::format("{} hands over packets that are longer than its MTU: {}", from.interface,
                          cure.empty() ? fmt::format("it puts segments together. Switch that "
                                                     "off: ethtool -K {} gro off lro off",
                                                     from.interface)
                                       : cure);
}

/// Sends the answer at once, as if the emulator's interface were the router.
void Frames::answer_too_big(End& from, std::size_t mtu, std::span<const std::byte> frame)
{
    const auto answer = too_big_answer(frame, mtu);
    if (answer.empty()) return;
    const std::array<std::span<const std::byte>, 1> batch{answer};
    if (from.socket.send_batch(batch).front() == net::SendOutcome::sent) ++from.told_too_big;
}

/// Watches for a machine whose frames arrive from alternating ends. It is then behind both of them,
/// and frames would circulate for ever.
void Frames::watch_for_loop(std::size_t from, const Frame& frame)
{
    constexpr base::Duration recent = std::chrono::seconds{1};
    constexpr unsigned moves_max = 5;
    if (frame.header_bytes < Frame::header_bytes_min || is_group(frame.source)) return;
    Heard& heard = heard_[place_of(frame.source)];
    if (heard.who != frame.source || arrival_ - heard.at > recent) {
        heard = {frame.source, from, arrival_, 0};
        return;
    }
    heard.at = arrival_;
    const auto before = std::exchange(heard.end, from);
    if (before == from) return;
    if (++heard.moves < moves_max || failure_) return;
    std::string address;
    for (const std::byte byte : frame.source) {
        address +=
            fmt::format("{}{:02x}", address.empty() ? "" : ":", std::to_integer<unsigned>(byte));
    }
    const auto [first, second] = std::minmax(before, from);
    failure_ =
        fmt::format("a loop: {} sends on {} and on {}, so the two are joined elsewhere, too. "
                    "Take the other way between them away, and start again",
                    address, ends_[first].interface, ends_[second].interface);
}

bool Frames::send_due(const Pair& pair, const FrameWay& way, base::TimePoint now)
{
    if (!base::is_due(way.path->link(way.direction).next_deadline(), now)) return false;
    FrameBatch& leaving = ends_[way.direction == Direction::up ? pair.b : pair.a].leaving;
    for (std::size_t i = 0; i < net::PacketSocket::batch_max; ++i) {
        const auto departure = way.path->poll(way.direction, now);
        if (!departure) {
            leaving.flush();
            return false;
        }
        leaving.add(way, *departure);
    }
    leaving.flush();
    return true;
}

void Frames::release(base::TimePoint now)
{
    paths_.each_due(
        now, [&](std::size_t number) { release(*by_path_[number], paths_.at(number), now); });
}

void Frames::release(const Pair& pair, EmulatedPath& path, base::TimePoint now)
{
    const FrameWay up{&path, Direction::up, pair.number};
    const FrameWay down{&path, Direction::down, pair.number};
    bool up_has_more = true;
    bool down_has_more = true;
    for (int round = 0; round < release_rounds_max && (up_has_more || down_has_more); ++round) {
        if (up_has_more) up_has_more = send_due(pair, up, now);
        if (down_has_more) down_has_more = send_due(pair, down, now);
    }
}

std::optional<std::string> Frames::next_notice() { return std::exchange(untold_, std::nullopt); }

} // namespace hapnet::emulator::ports
