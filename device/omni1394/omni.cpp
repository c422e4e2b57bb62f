// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/omni.hpp"

#include "device/omni1394/start_sequence.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <glm/glm.hpp>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::device::omni1394 {

namespace {

constexpr int last_words = 3;
// The least number of cycles between two beats. A beat comes only with a packet. No source says if
// the device sends 1000 packets a second or one in each of the bus's 8000 cycles.
constexpr unsigned beat_cycles = 6;
constexpr unsigned cycles_per_second = 8000;
constexpr std::size_t news_per_beat_max = 16;
// The number of packets in two seconds. A greater gap means that the device has started to count
// from the beginning.
constexpr std::uint32_t skipped_max = 2 * cycles_per_second;

std::string_view describe(Use use)
{
    switch (use) {
    case Use::read_only:
        return "read-only: its torque per count is not known; see docs/use/devices.md to measure "
               "it";
    case Use::uncalibrated: return "force uncalibrated, at most a quarter of full scale";
    case Use::measured: return "force by a measured table";
    }
    return "";
}

Capabilities capabilities_of(const Drive& drive)
{
    Capabilities can;
    can.workspace_min = {-omni::half_workspace_m};
    can.workspace_max = {omni::half_workspace_m};
    can.resolution_m = omni::radians_per_count * omni::link_m;
    can.friction_n = omni::friction_n;
    can.speed_max_m_per_s = 1.0;
    can.buttons = 2;
    can.has_holder = true;
    can.pacing = Pacing::device;
    drive.describe(can);
    return can;
}

/// Carries out the register accesses of the sequence. Returns the serial number.
Opened<std::string> run(Link& link, StartSequence& sequence)
{
    std::array<std::byte, 4> buffer{};
    while (const auto access = sequence.next()) {
        const auto room = std::span{buffer}.first(access->size);
        const auto answer = access->writes
                                ? link.write_register(access->address, access->to_write())
                                : link.read_register(access->address, room);
        if (!answer) return tl::unexpected{answer.error()};
        sequence.on_answer(room.first(access->writes ? 0 : std::min(*answer, room.size())));
    }
    if (sequence.is_done()) return sequence.serial();
    return device_error(
        Fault::communication,
        fmt::format("the Omni did not start: {}. Unplug it, plug it in and try again",
                    sequence.failure()));
}

} // namespace

Opened<std::unique_ptr<Device>> Omni::open(std::unique_ptr<Link> link, const Profile& profile,
                                           Use use)
{
    const auto channels = link->allocate();
    if (!channels) return tl::unexpected{channels.error()};
    // Both directions are open before the device starts to send, and the first command that it
    // receives is zero.
    const auto started = link->start(*channels);
    if (!started) return tl::unexpected{started.error()};
    link->send(HostPacket{});
    StartSequence sequence{*channels, profile.writes_dubious_register};
    auto serial = run(*link, sequence);
    if (!serial) return tl::unexpected{serial.error()};
    return std::unique_ptr<Device>{
        new Omni{Started{std::move(link), *std::move(serial)}, profile, use}};
}

Omni::Omni(Started started, const Profile& profile, Use use)
    : link_{std::move(started.link)}, drive_{use, profile}, tracker_{profile.inkwell}
{
    identity_ = {.backend = "omni1394",
                 .serial = std::move(started.serial),
                 .model = "PHANToM Omni (FireWire)",
                 .note = fmt::format("{}; {}", never_run, describe(use))};
    capabilities_ = capabilities_of(drive_);
}

Omni::~Omni()
{
    for (int i = 0; i < last_words; ++i) link_->send(HostPacket{});
    if (has_gone_) return;
    try {
        link_->drain();
        const RegisterAccess stop = stop_streaming();
        std::ignore = link_->write_register(stop.address, stop.to_write());
    } catch (const std::exception&) {
        // The link's destructor stops the rest: it closes its descriptors, and the kernel ends the
        // stream.
        return;
    }
}

CalibrationStep Omni::calibrate(base::TimePoint /*now*/) { return tracker_.calibration(); }

Sample Omni::read(base::TimePoint now)
{
    std::ignore = gather();
    for (std::size_t i = 0; i < news_count_; ++i) {
        switch (news_[i].arrival) {
        case Arrival::packet: take(news_[i].packet, now); break;
        case Arrival::bus_reset: tracker_.on_break(); break;
        case Arrival::gone:
            has_gone_ = true;
            tracker_.on_gone();
            break;
        case Arrival::nothing: break;
        }
    }
    news_count_ = 0;
    sample_ = tracker_.at(now);
    return sample_;
}

bool Omni::gather()
{
    while (news_count_ < news_.size()) {
        News& next = news_[news_count_];
        next.arrival = link_->receive(next.packet);
        if (next.arrival == Arrival::nothing) break;
        ++news_count_;
        if (next.arrival == Arrival::gone) break;
    }
    if (news_count_ == 0) return false;
    const News& last = news_[news_count_ - 1];
    if (last.arrival != Arrival::packet || news_count_ >= news_per_beat_max) return true;
    const unsigned since =
        beat_cycle_ ? last.packet.cycle + cycles_per_second - *beat_cycle_ : cycles_per_second - 1;
    if (since % cycles_per_second < beat_cycles) return false;
    beat_cycle_ = last.packet.cycle;
    return true;
}

void Omni::take(const ReceivedPacket& received, base::TimePoint now)
{
    const auto packet = decode_device(received.content());
    if (!packet) {
        ++garbled_;
        return tracker_.on_nonsense();
    }
    const std::uint32_t skipped = message_ ? packet->message - *message_ - 1 : 0;
    message_ = packet->message;
    if (skipped > skipped_max) {
        tracker_.on_break();
    } else {
        lost_ += skipped;
    }
    tracker_.on_report({packet->counts, packet->docked, packet->buttons, skipped}, now);
}

/// Returns the lights. Fast flashes request the stylus in its inkwell; a steady light means that
/// all is well.
HostPacket Omni::lights() const
{
    HostPacket packet;
    packet.dock_light_flashes = sample_.calibrated;
    packet.dock_light_flashes_fast = true;
    return packet;
}

void Omni::apply(const GovernedForce& force)
{
    HostPacket packet = lights();
    if (force.motors_on() && drive_.use() != Use::read_only && tracker_.may_push()) {
        const glm::dmat3 jacobian = omni::jacobian_at(sample_.hip);
        packet.motors = drive_.motor_words(glm::transpose(jacobian) * force.force().value);
        packet.motors_on = true;
    }
    link_->send(packet);
}

void Omni::halt() noexcept { link_->send(HostPacket{}); }

void Omni::pace(const std::function<bool()>& beat)
{
    constexpr base::Duration silence_max{std::chrono::milliseconds{100}};
    while (!has_gone_ && link_->wait(silence_max)) {
        if (gather() && !beat()) return;
    }
}

} // namespace hapnet::device::omni1394
