// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/falcon/fake_falcon.hpp"

#include "device/falcon/falcon.hpp"

#include <algorithm>
#include <array>
#include <glm/matrix.hpp>
#include <utility>

namespace hapnet::test {

using namespace device::falcon;

namespace {

constexpr std::uint8_t to_vendor = 0x40;
constexpr unsigned slow_baud = 0x4138;
constexpr unsigned loader_baud = 0x0015;
constexpr unsigned normal_baud = 0x0002;
constexpr std::array hello{std::byte{0x0a}, std::byte{0x43}, std::byte{0x0d}};
constexpr std::array answer{std::byte{0x0a}, std::byte{0x44}, std::byte{0x2c}, std::byte{0x0d}};
constexpr std::byte fast_hello{0x41};
constexpr std::array chip_status{std::byte{0x01}, std::byte{0x60}};

constexpr double mass_kg = 0.10; // of the grip, and of the hand that holds it
constexpr double hand_stiffness_n_per_m = 300.0;
constexpr double hand_damping_ns_per_m = 8.0;
constexpr double free_damping_ns_per_m = 2.0;
constexpr double step_s = 0.00025;
constexpr double lives_at_most_s = 0.02; // at once; a longer absence of the host is skipped
constexpr double reach_of_grip_m = 0.060;
constexpr double stop_rad = -0.9; // the legs' lower stops, -52 degrees
const base::Position all_the_way_in{{0.0, 0.0, -0.055}};
constexpr double hand_speed_m_per_s = 0.2;

} // namespace

umockdev::UsbDescription usb_of_falcon(const std::string& serial, int address)
{
    return {.vendor = 0x0403,
            .product = 0xcb48,
            .vendor_name = "Novint",
            .product_name = "FALCON HAPTIC",
            .serial = serial,
            .address = address};
}

const std::vector<std::byte>& FakeFalcon::firmware()
{
    static const std::vector<std::byte> bytes = [] {
        std::vector<std::byte> made(1000); // 16 chunks of 62 bytes and one of 8
        for (std::size_t i = 0; i < made.size(); ++i)
            made[i] = static_cast<std::byte>(i * 37 % 251);
        return made;
    }();
    return bytes;
}

FakeFalcon::FakeFalcon(Clock clock)
    : clock_{std::move(clock)}, power_up_{encoders_at(inverse(grip_).value())}
{
    lived_until_ = clock_();
    last_answer_ = lived_until_;
}

std::optional<std::vector<std::byte>> FakeFalcon::on_control(const umockdev::UsbSetup& setup,
                                                             std::span<const std::byte> /*data*/)
{
    if (setup.type != to_vendor) return std::nullopt;
    switch (setup.request) {
    case 0: // reset, 1: bytes for the host
        if (setup.value <= 1) to_host_.clear();
        break;
    case 1: // modem lines: a rising DTR starts the loader anew
        if (setup.value == 0x0101 && stage_ != Stage::running) stage_ = Stage::cold;
        break;
    case 2: // flow control
    case 4: // data format
        break;
    case 3: baud_ = setup.value; break;
    case 9: latency_ = std::chrono::milliseconds{setup.value}; break;
    default: return std::nullopt;
    }
    return std::vector<std::byte>{};
}

void FakeFalcon::on_bulk_out(std::span<const std::byte> bytes)
{
    for (const std::byte byte : bytes) {
        if (stage_ != Stage::running) {
            load(byte);
        } else if (baud_ == normal_baud) {
            const auto packet = finder_.feed(byte);
            const auto command = packet ? decode_command(*packet) : std::nullopt;
            if (command) obey(*command);
        }
    }
}

void FakeFalcon::load(std::byte byte)
{
    from_host_.push_back(byte);
    const auto is_last = [&](const auto& words) {
        return from_host_.size() >= words.size() &&
               std::equal(words.rbegin(), words.rend(), from_host_.rbegin());
    };
    if (baud_ == slow_baud && is_last(hello)) {
        to_host_.insert(to_host_.end(), answer.begin(), answer.end());
        stage_ = Stage::greeted;
        from_host_.clear();
    } else if (baud_ == loader_baud && stage_ == Stage::greeted && byte == fast_hello) {
        to_host_.push_back(byte);
        stage_ = Stage::loading;
        from_host_.clear();
        ++loads_;
    } else if (baud_ == loader_baud && stage_ == Stage::loading) {
        const bool spoils = loads_ <= spoiled_loads_ && from_host_.size() > 100;
        to_host_.push_back(spoils ? ~byte : byte);
        if (from_host_ == firmware()) stage_ = Stage::running;
    }
}

std::optional<std::vector<std::byte>> FakeFalcon::on_bulk_in(std::size_t size)
{
    const base::TimePoint now = clock_();
    if (to_host_.empty() && now - last_answer_ < latency_) return std::nullopt;
    last_answer_ = now;
    std::vector<std::byte> said{chip_status.begin(), chip_status.end()};
    while (!to_host_.empty() && said.size() < size) {
        said.push_back(to_host_.front());
        to_host_.pop_front();
    }
    return said;
}

void FakeFalcon::obey(const Command& command)
{
    const base::TimePoint now = clock_();
    live_until(now); // by the command before this one
    command_ = command;
    commands_.push_back(command);
    if (command.motors != Counts{}) last_push_ = now;
    if (is_garbling_) {
        to_host_.insert(to_host_.end(), {std::byte{'<'}, std::byte{0xff}, std::byte{'>'}});
        return;
    }
    const Packet packet = encode(report());
    to_host_.insert(to_host_.end(), packet.begin(), packet.end());
}

void FakeFalcon::live_until(base::TimePoint now)
{
    double left = std::min(base::to_seconds(now - lived_until_), lives_at_most_s);
    lived_until_ = now;
    for (; left > 0.0; left -= step_s) step(std::min(left, step_s));
}

void FakeFalcon::move_aim(double seconds)
{
    const bool homes = helps_homing_ && command_.home && legs_homed_ != all_legs;
    const auto goal = homes ? std::optional{all_the_way_in} : wanted_;
    if (!goal) {
        aim_.reset();
        return;
    }
    const base::Position from = aim_.value_or(grip_);
    aim_ = from + base::limited(*goal - from, hand_speed_m_per_s * seconds);
}

void FakeFalcon::step(double seconds)
{
    move_aim(seconds);
    const glm::dmat3 map = jacobian(grip_);
    glm::dvec3 torque{};
    for (int i = 0; i < 3; ++i) {
        torque[i] = -command_.motors[static_cast<std::size_t>(i)] / counts_per_newton_metre;
    }
    force_ = {glm::determinant(map) == 0.0 ? glm::dvec3{0.0}
                                           : glm::inverse(glm::transpose(map)) * torque};
    glm::dvec3 sum = force_.value;
    if (aim_) {
        sum += hand_stiffness_n_per_m * (aim_->value - grip_.value) -
               hand_damping_ns_per_m * velocity_.value;
    } else {
        sum -= free_damping_ns_per_m * velocity_.value;
    }
    velocity_.value += seconds / mass_kg * sum;
    const base::Displacement from_middle{grip_.value + seconds * velocity_.value};
    grip_ = {base::limited(from_middle, reach_of_grip_m).value};
    if (base::norm(from_middle) > reach_of_grip_m) velocity_ = {};
    const auto angles = inverse(grip_);
    for (unsigned leg = 0; angles && command_.home && leg < 3; ++leg) {
        const bool at_stop = (*angles)[static_cast<int>(leg)] <= stop_rad;
        if (at_stop) legs_homed_ = static_cast<std::uint8_t>(legs_homed_ | 1U << leg);
    }
}

Report FakeFalcon::report()
{
    Report report{.buttons = buttons_, .legs_homed = legs_homed_};
    const auto angles = inverse(grip_);
    if (angles) report.encoders = encoders_at(*angles);
    for (unsigned leg = 0; leg < 3; ++leg) {
        if ((legs_homed_ >> leg & 1U) != 0) continue;
        report.encoders[leg] = static_cast<std::int16_t>(report.encoders[leg] - power_up_[leg]);
    }
    return report;
}

} // namespace hapnet::test
