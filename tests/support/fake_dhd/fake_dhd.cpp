// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The functions of the interface, as we read it, over two devices that a hand holds.
#include "tests/support/fake_dhd/fake_dhd.hpp"

#include "device/dhd/library.hpp"

#include <array>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <vector>

namespace hapnet::device::dhd {

namespace {

constexpr double grip_n_per_m = 300.0; // of the hand that holds it
constexpr std::array<unsigned short, 2> serials{4711, 4712};

struct FakeDevice {
    bool is_open = false;
    bool calibrated = false;
    bool pressed = false;
    bool unplugged = false;
    bool garbled = false;
    bool stalled = false;
    bool tripped = false;
    bool in_error = false;
    bool motors_on = true; // the library's state without a command
    std::array<double, 3> tip_m{};
    std::array<double, 3> velocity_m_per_s{};
    std::vector<FakeDhdCommand> commands;
};

struct Library {
    std::mutex mutex; // protects all members below
    std::condition_variable changed;
    std::array<FakeDevice, serials.size()> devices;
};

Library& library()
{
    // Never destroyed: like the real library it may be in use when the process ends.
    static Library& it = *new Library;
    return it;
}

thread_local int latest_error = error::none;

int fail(int code)
{
    latest_error = code;
    return failed;
}

/// Calls `what` with the open device. While the device is stalled, it waits first.
template <typename What>
int with_device(Id id, What what)
{
    Library& it = library();
    std::unique_lock lock{it.mutex};
    if (id < 0 || static_cast<std::size_t>(id) >= it.devices.size()) return fail(error::no_device);
    FakeDevice& device = it.devices.at(static_cast<std::size_t>(id));
    it.changed.wait(lock, [&] { return !device.stalled; });
    if (!device.is_open) return fail(error::no_device);
    if (device.unplugged) return fail(error::communication);
    return what(device);
}

int tell_vector(const std::array<double, 3>& it, double* x, double* y, double* z)
{
    *x = it[0];
    *y = it[1];
    *z = it[2];
    return 0;
}

} // namespace

extern "C" {

int dhdGetDeviceCount() { return static_cast<int>(serials.size()); }

int dhdOpenID(Id index)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    if (index < 0 || static_cast<std::size_t>(index) >= it.devices.size()) {
        return fail(error::no_device);
    }
    FakeDevice& device = it.devices.at(static_cast<std::size_t>(index));
    if (device.unplugged) return fail(error::no_device);
    if (device.is_open) return fail(error::in_use);
    device.is_open = true;
    return index;
}

int dhdClose(Id id)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    it.devices.at(static_cast<std::size_t>(id)).is_open = false;
    return 0;
}

int dhdGetSerialNumber(unsigned short* serial, Id id)
{
    *serial = serials.at(static_cast<std::size_t>(id));
    return 0;
}

const char* dhdGetSystemName(Id /*id*/) { return "fake omega.3"; }

int dhdEnableForce(unsigned char on, Id id)
{
    return with_device(id, [&](FakeDevice& device) {
        device.motors_on = on != 0;
        if (!device.motors_on) device.commands.push_back({{0.0, 0.0, 0.0}, false});
        return 0;
    });
}

int dhdGetStatus(int* status, Id id)
{
    return with_device(id, [&](FakeDevice& device) {
        status[status::power] = 1;
        status[status::connected] = 1;
        status[status::needs_calibration] = device.calibrated ? 0 : 1;
        status[status::force] = device.motors_on && !device.tripped ? 1 : 0;
        status[status::error] = device.in_error ? 1 : 0;
        status[status::force_off_cause] = device.tripped ? force_off::velocity : 0;
        return 0;
    });
}

int dhdGetPosition(double* x, double* y, double* z, Id id)
{
    return with_device(id, [&](FakeDevice& device) {
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        return tell_vector(device.garbled ? std::array{nan, nan, nan} : device.tip_m, x, y, z);
    });
}

int dhdGetLinearVelocity(double* x, double* y, double* z, Id id)
{
    return with_device(
        id, [&](FakeDevice& device) { return tell_vector(device.velocity_m_per_s, x, y, z); });
}

int dhdSetForce(double x, double y, double z, Id id)
{
    return with_device(id, [&](FakeDevice& device) {
        device.commands.push_back({{x, y, z}, device.motors_on});
        const bool pushes = device.motors_on && !device.tripped;
        const std::array<double, 3> force{pushes ? x : 0.0, pushes ? y : 0.0, pushes ? z : 0.0};
        for (std::size_t axis = 0; axis < force.size(); ++axis) {
            const double moved = 0.05 * (force[axis] / grip_n_per_m - device.tip_m[axis]);
            device.tip_m[axis] += moved;
            device.velocity_m_per_s[axis] = moved / 0.001;
        }
        return 0;
    });
}

int dhdGetButton(int /*index*/, Id id)
{
    return with_device(id, [](FakeDevice& device) { return device.pressed ? 1 : 0; });
}

int dhdErrorGetLast() { return latest_error; }

void fakedhd_reset()
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    it.devices = {};
}

void fakedhd_set(int index, FakeDhdFate fate, bool on)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    FakeDevice& device = it.devices.at(static_cast<std::size_t>(index));
    switch (fate) {
    case FakeDhdFate::calibrated: device.calibrated = on; break;
    case FakeDhdFate::pressed: device.pressed = on; break;
    case FakeDhdFate::unplugged: device.unplugged = on; break;
    case FakeDhdFate::garbled: device.garbled = on; break;
    case FakeDhdFate::stalled: device.stalled = on; break;
    case FakeDhdFate::tripped: device.tripped = on; break;
    case FakeDhdFate::in_error: device.in_error = on; break;
    }
    it.changed.notify_all();
}

std::size_t fakedhd_commands(int index, std::size_t first, FakeDhdCommand* to, std::size_t room)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    const auto& commands = it.devices.at(static_cast<std::size_t>(index)).commands;
    for (std::size_t i = 0; i < room && first + i < commands.size(); ++i) {
        to[i] = commands[first + i];
    }
    return commands.size();
}
}

} // namespace hapnet::device::dhd
