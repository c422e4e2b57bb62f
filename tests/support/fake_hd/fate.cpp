// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/fake_hd/fake_library.hpp"

namespace hapnet::device::hdapi {

extern "C" {

void fakehd_reset()
{
    Library& it = library();
    stop_scheduler();
    const std::lock_guard lock{it.mutex};
    it.devices = {};
    it.errors.clear();
    it.current = no_device;
    it.callback = nullptr;
    it.misuse = {};
    it.stalled = false;
}

void fakehd_set(std::size_t index, FakeHdFate fate, bool on)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    FakeDevice& device = it.devices.at(index);
    switch (fate) {
    case FakeHdFate::docked: device.docked = on; break;
    case FakeHdFate::calibrated: device.calibrated = on; break;
    case FakeHdFate::pressed: device.pressed = on; break;
    case FakeHdFate::unplugged: device.unplugged = on; break;
    case FakeHdFate::garbled: device.garbled = on; break;
    case FakeHdFate::warm: device.warm = on; break;
    case FakeHdFate::stalled: it.stalled = on; break;
    }
}

void fakehd_fail_frame(std::size_t index, std::uint64_t n)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    it.devices.at(index).failing_frame = n;
}

void fakehd_complain(std::size_t index, unsigned int code)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    it.complain(code, index < it.devices.size() ? static_cast<Handle>(index) : no_device);
}

std::size_t fakehd_commands(std::size_t index, std::size_t first, FakeHdCommand* to,
                            std::size_t room)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    const auto& commands = it.devices.at(index).commands;
    for (std::size_t i = 0; i < room && first + i < commands.size(); ++i)
        to[i] = commands[first + i];
    return commands.size();
}

FakeHdMisuse fakehd_misuse()
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    return it.misuse;
}
}

} // namespace hapnet::device::hdapi
