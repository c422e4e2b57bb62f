// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/evdev_switch.hpp"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::peer::loop {

namespace {

constexpr int reads_max = 4; // reads per call, of up to 64 events each

} // namespace

bool KeysDown::on_events(std::span<const input_event> events)
{
    for (const input_event& event : events) {
        if (event.type == EV_SYN && event.code == SYN_DROPPED) return false;
        if (event.type != EV_KEY || event.code >= down_.size()) continue;
        down_.set(event.code, event.value != 0); // a value of 2 repeats a held key
    }
    return true;
}

void KeysDown::set(std::span<const unsigned char> bits)
{
    down_.reset();
    for (std::size_t key = 0; key < down_.size() && key / 8 < bits.size(); ++key) {
        if ((bits[key / 8] >> (key % 8) & 1U) != 0) down_.set(key);
    }
}

EvdevSwitch::EvdevSwitch(const std::string& path)
    : descriptor_{open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)}
{
    const auto refuse = [&](const char* what) {
        const int error = errno;
        if (descriptor_ >= 0) close(descriptor_);
        throw std::system_error{error, std::generic_category(),
                                fmt::format("--dead-man evdev: cannot {} {}", what, path)};
    };
    if (descriptor_ < 0) refuse("open");
    if (ioctl(descriptor_, EVIOCGRAB, 1) != 0) refuse("grab");
    if (!read_keys()) refuse("read the keys of");
}

EvdevSwitch::~EvdevSwitch()
{
    if (descriptor_ >= 0) close(descriptor_);
}

EvdevSwitch::EvdevSwitch(EvdevSwitch&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)}, keys_{other.keys_}
{}

EvdevSwitch& EvdevSwitch::operator=(EvdevSwitch&& other) noexcept
{
    std::swap(descriptor_, other.descriptor_);
    std::swap(keys_, other.keys_);
    return *this;
}

bool EvdevSwitch::read_keys()
{
    std::array<unsigned char, KEY_CNT / 8> bits{};
    if (ioctl(descriptor_, EVIOCGKEY(bits.size()), bits.data()) < 0) return false;
    keys_.set(bits);
    return true;
}

void EvdevSwitch::give_up() { close(std::exchange(descriptor_, -1)); }

bool EvdevSwitch::is_held()
{
    std::array<input_event, 64> events; // NOLINT(*-member-init): only what is read is used
    for (int i = 0; i < reads_max && descriptor_ >= 0; ++i) {
        const auto bytes = read(descriptor_, events.data(), sizeof events);
        if (bytes < 0 && (errno == EAGAIN || errno == EINTR)) break;
        if (bytes <= 0) { // ENODEV: the input was unplugged
            give_up();
            break;
        }
        const auto count = static_cast<std::size_t>(bytes) / sizeof(input_event);
        if (!keys_.on_events(std::span{events}.first(count)) && !read_keys()) give_up();
        if (count < events.size()) break;
    }
    return descriptor_ >= 0 && keys_.any();
}

} // namespace hapnet::peer::loop
