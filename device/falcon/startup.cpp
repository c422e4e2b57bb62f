// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/startup.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hapnet::device::falcon {

namespace {

// Requests of FTDI's chips, as in the kernel's drivers/usb/serial/ftdi_sio.h.
constexpr std::uint8_t reset = 0;
constexpr std::uint8_t modem_control = 1;
constexpr std::uint8_t flow_control = 2;
constexpr std::uint8_t baud_rate = 3;
constexpr std::uint8_t data_format = 4;
constexpr std::uint8_t latency_timer = 9;

constexpr ChipRequest purge_received{reset, 1};
constexpr ChipRequest purge_sent{reset, 2};
constexpr ChipRequest dtr_low{modem_control, 0x0100};
constexpr ChipRequest dtr_high{modem_control, 0x0101};
constexpr ChipRequest rts_low{modem_control, 0x0200};

constexpr std::array to_normal{ChipRequest{latency_timer, 1},
                               ChipRequest{baud_rate, 0x0002}, // 1.5 Mbit/s
                               purge_received, purge_sent};
constexpr std::array to_loader{purge_received,
                               purge_sent,
                               ChipRequest{latency_timer, 16},
                               ChipRequest{baud_rate, 0x4138}, // 9600 bit/s
                               ChipRequest{data_format, 8},    // 8 bits, no parity, 1 stop bit
                               ChipRequest{flow_control, 0},
                               rts_low,
                               dtr_low,
                               dtr_high};
constexpr std::array to_fast_loader{dtr_low, ChipRequest{baud_rate, 0x0015}}; // 140 kbit/s

constexpr std::array hello{std::byte{0x0a}, std::byte{0x43}, std::byte{0x0d}};
constexpr std::array hello_back{std::byte{0x0a}, std::byte{0x44}, std::byte{0x2c}, std::byte{0x0d}};
constexpr std::array fast_hello{std::byte{0x41}}; // the loader answers with the same byte

constexpr std::size_t chunk_bytes = 62; // a full USB packet when the chip adds its two status bytes
constexpr std::size_t heard_max = 1024; // no loader sends more than this

constexpr base::Duration answer_max{std::chrono::milliseconds{100}};

template <std::size_t size>
std::vector<std::byte> bytes_of(const std::array<std::byte, size>& bytes)
{
    return {bytes.begin(), bytes.end()};
}

// Limits by phase. The first limit is the number of tries of each message. The second is the number
// of answers of the chip without a byte from the Falcon after which the message is sent again. Such
// answers come every 16 ms from a loader, and otherwise every 1 ms.
constexpr std::array tries_max{10, 30, 3, 1};
constexpr std::array empty_max{30, 4, 10, 30};

} // namespace

Startup::Startup(std::vector<std::byte> firmware) : firmware_{std::move(firmware)}
{
    begin(Phase::greet);
}

void Startup::begin(Phase phase)
{
    phase_ = phase;
    tries_ = 0;
    plan_.clear();
    const auto plan = [&](const auto& asks) { plan_.assign(asks.rbegin(), asks.rend()); };
    switch (phase) {
    case Phase::greet: plan(to_normal); break;
    case Phase::call_loader: plan(to_loader); break;
    case Phase::call_fast_loader: plan(to_fast_loader); break;
    case Phase::load: loaded_ = 0; break;
    }
    advance();
}

/// Continues the phase: first with its preparations, then with its own messages.
void Startup::advance()
{
    if (plan_.empty()) {
        say();
        return;
    }
    step_ = plan_.back();
    plan_.pop_back();
}

void Startup::say()
{
    ++tries_;
    empty_ = 0;
    heard_.clear();
    switch (phase_) {
    case Phase::greet: step_ = SendBytes{bytes_of(encode(Command{}))}; return;
    case Phase::call_loader: step_ = SendBytes{bytes_of(hello)}; return;
    case Phase::call_fast_loader: step_ = SendBytes{bytes_of(fast_hello)}; return;
    case Phase::load: step_ = SendBytes{{chunk().begin(), chunk().end()}}; return;
    }
}

std::span<const std::byte> Startup::chunk() const
{
    const auto rest = std::span{firmware_}.subspan(loaded_);
    return rest.first(std::min(rest.size(), chunk_bytes));
}

void Startup::on_done()
{
    if (std::holds_alternative<SendBytes>(step_)) {
        step_ = Listen{answer_max};
    } else if (std::holds_alternative<ChipRequest>(step_)) {
        advance();
    }
}

void Startup::on_heard(std::span<const std::byte> bytes)
{
    if (!std::holds_alternative<Listen>(step_)) return;
    switch (answer_in(bytes)) {
    case Answer::right: next_phase(); return;
    case Answer::wrong: next_attempt(); return;
    case Answer::incomplete: break;
    }
    if (bytes.empty() && ++empty_ >= empty_max[static_cast<std::size_t>(phase_)]) on_silence();
}

void Startup::on_silence()
{
    if (std::holds_alternative<ChipRequest>(step_)) {
        refuse(Fault::communication, "the Falcon's USB chip takes no requests: unplug it and plug "
                                     "it in again, into a port of the computer itself");
    } else if (tries_ < tries_max[static_cast<std::size_t>(phase_)]) {
        say();
    } else if (!std::holds_alternative<Refused>(step_) && !std::holds_alternative<Ready>(step_)) {
        next_attempt();
    }
}

Startup::Answer Startup::answer_in(std::span<const std::byte> bytes)
{
    if (phase_ == Phase::greet) {
        bool is_report = false;
        for (const std::byte byte : bytes) {
            const auto packet = finder_.feed(byte);
            is_report = is_report || (packet && decode_report(*packet));
        }
        return is_report ? Answer::right : Answer::incomplete;
    }
    heard_.insert(heard_.end(), bytes.begin(), bytes.end());
    const auto holds = [&](const auto& words) {
        const bool is_there =
            std::search(heard_.begin(), heard_.end(), words.begin(), words.end()) != heard_.end();
        if (is_there) return Answer::right;
        return heard_.size() < heard_max ? Answer::incomplete : Answer::wrong;
    };
    if (phase_ == Phase::call_loader) return holds(hello_back);
    if (phase_ == Phase::call_fast_loader) return holds(fast_hello);
    const bool is_echo = heard_.size() <= chunk().size() &&
                         std::equal(heard_.begin(), heard_.end(), chunk().begin());
    if (!is_echo) return Answer::wrong;
    return heard_.size() == chunk().size() ? Answer::right : Answer::incomplete;
}

void Startup::next_phase()
{
    switch (phase_) {
    case Phase::greet: step_ = Ready{}; return;
    case Phase::call_loader: begin(Phase::call_fast_loader); return;
    case Phase::call_fast_loader: begin(Phase::load); return;
    case Phase::load: break;
    }
    loaded_ += heard_.size();
    if (loaded_ == firmware_.size()) {
        begin(Phase::greet);
    } else {
        say();
    }
}

void Startup::next_attempt()
{
    if (firmware_.empty()) {
        refuse(Fault::firmware_missing,
               "the Falcon does not run its firmware: give it by --falcon-firmware FILE. It is "
               "Novint's, comes with their drivers, and may not be passed on with hapnet");
    } else if (attempts_ == attempts_max) {
        refuse(Fault::communication,
               "the Falcon did not start its firmware: check that the file is Novint's firmware, "
               "unplug the Falcon and its power, plug it into a port of the computer itself, and "
               "try again");
    } else {
        ++attempts_;
        begin(Phase::call_loader);
    }
}

void Startup::refuse(Fault fault, std::string message)
{
    step_ = Refused{{.fault = fault, .message = std::move(message)}};
}

} // namespace hapnet::device::falcon
