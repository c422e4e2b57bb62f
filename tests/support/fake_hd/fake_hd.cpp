// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The functions of the interface, as we read it.
#include "tests/support/fake_hd/fake_library.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string_view>

namespace hapnet::device::hdapi {

namespace {

constexpr double resolution_mm = 0.055;
constexpr double grip_n_per_mm = 0.3; // of the hand that holds the stylus
constexpr double force_max_n = 3.3;

void move_tip(FakeDevice& device, const glm::dvec3& force)
{
    const glm::dvec3 before = device.tip_mm;
    device.tip_mm += 0.05 * (force / grip_n_per_mm - device.tip_mm);
    device.velocity_mm_per_s = 1000.0 * (device.tip_mm - before);
}

std::array<double, 3> read_vector(const FakeDevice& device, unsigned int what)
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    if (what == parameter::velocity) {
        const glm::dvec3& v = device.velocity_mm_per_s;
        return {v.x, v.y, v.z};
    }
    std::array<double, 3> position{};
    for (const int axis : {0, 1, 2}) {
        const double counts = std::round(device.tip_mm[axis] / resolution_mm);
        position[static_cast<std::size_t>(axis)] = device.garbled ? nan : resolution_mm * counts;
    }
    return position;
}

} // namespace

extern "C" {

Handle hdInitDevice(const char* name)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    if (it.running) ++it.misuse.initialised_while_running;
    const std::string_view wanted = name == nullptr ? names[0] : name;
    const auto found = std::find(names.begin(), names.end(), wanted);
    const auto index = static_cast<Handle>(found - names.begin());
    if (found == names.end() || it.devices[index].unplugged) {
        it.complain(error::communication, no_device);
        return no_device;
    }
    if (it.devices[index].is_open) {
        it.complain(error::already_open, index);
        return no_device;
    }
    it.devices[index].is_open = true;
    it.current = index;
    return index;
}

void hdDisableDevice(Handle handle)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    if (FakeDevice* device = it.device(handle)) device->is_open = false;
}

void hdMakeCurrentDevice(Handle handle)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    if (it.device(handle) != nullptr) it.current = handle;
}

void hdBeginFrame(Handle handle)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    FakeDevice* device = it.device(handle);
    if (device == nullptr) return;
    if (std::this_thread::get_id() != it.scheduler.get_id()) ++it.misuse.frames_off_scheduler;
    if (device->in_frame) {
        ++it.misuse.nested_frames;
        it.complain(0x400, handle);
    }
    device->in_frame = true;
    device->frame_force = glm::dvec3{0.0};
}

void hdEndFrame(Handle handle)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    FakeDevice* device = it.device(handle);
    if (device == nullptr) return;
    if (!device->in_frame) return it.complain(0x401, handle);
    device->in_frame = false;
    const bool fails = device->failing_frame == 1;
    if (device->failing_frame > 0) --device->failing_frame;
    if (device->unplugged || fails) return it.complain(error::communication, handle);
    if (device->warm) it.complain(error::warm_motors, handle);
    glm::dvec3 force = device->frame_force;
    const double size = glm::length(force);
    if (!(size <= force_max_n)) {
        if (!device->clamps) it.complain(error::force_too_large, handle);
        force = device->clamps ? (force_max_n / size) * force : glm::dvec3{0.0};
    }
    note(handle, {{force.x, force.y, force.z}, device->force_output});
    move_tip(*device, device->force_output ? force : glm::dvec3{0.0});
}

ErrorInfo hdGetError()
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    if (it.errors.empty()) return {error::none, 0, no_device};
    const ErrorInfo latest = it.errors.back();
    it.errors.pop_back();
    return latest;
}

const char* hdGetErrorString(unsigned int code)
{
    return code == error::communication ? "fake: communication error" : "fake: error";
}

static void switch_capability(unsigned int capability, bool on)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    FakeDevice* device = it.device(it.current);
    if (device == nullptr) return;
    if (capability == capability::force_output)
        device->force_output = on;
    else if (capability == capability::force_clamping)
        device->clamps = on;
    else
        it.complain(0x100, it.current);
}
void hdEnable(unsigned int capability) { switch_capability(capability, true); }
void hdDisable(unsigned int capability) { switch_capability(capability, false); }

void hdGetBooleanv(unsigned int what, unsigned char* values)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    const FakeDevice* device = it.device(it.current);
    if (device == nullptr) return;
    if (what != parameter::inkwell_switch) return it.complain(0x100, it.current);
    *values = device->docked ? 0 : 1;
}

void hdGetIntegerv(unsigned int what, int* values)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    const FakeDevice* device = it.device(it.current);
    if (device == nullptr) return;
    switch (what) {
    case parameter::buttons: *values = device->pressed ? 1 : 0; break;
    case parameter::calibration_style: *values = calibration::style_inkwell; break;
    case parameter::update_rate: *values = 1000; break;
    default: it.complain(0x100, it.current);
    }
}

void hdGetDoublev(unsigned int what, double* values)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    const FakeDevice* device = it.device(it.current);
    if (device == nullptr) return;
    constexpr std::array workspace{-80.0, -60.0, -35.0, 80.0, 60.0, 35.0};
    switch (what) {
    case parameter::position:
    case parameter::velocity: {
        const auto vector = read_vector(*device, what);
        std::copy(vector.begin(), vector.end(), values);
        break;
    }
    case parameter::usable_workspace: std::copy(workspace.begin(), workspace.end(), values); break;
    case parameter::force_max: *values = force_max_n; break;
    case parameter::force_continuous: *values = 0.88; break;
    case parameter::stiffness_max: *values = 0.5; break;
    case parameter::damping_max: *values = 0.003; break;
    case parameter::velocity_limit: *values = 1000.0; break;
    default: it.complain(0x100, it.current);
    }
}

void hdSetDoublev(unsigned int what, const double* values)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    FakeDevice* device = it.device(it.current);
    if (device == nullptr) return;
    if (what != parameter::force) return it.complain(0x100, it.current);
    if (!device->in_frame) {
        ++it.misuse.force_outside_frame;
        return it.complain(0x102, it.current);
    }
    device->frame_force = {values[0], values[1], values[2]};
}

const char* hdGetString(unsigned int what)
{
    return what == parameter::model ? "fake Omni" : what == parameter::serial ? "0000" : "";
}

unsigned int hdCheckCalibration()
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    const FakeDevice* device = it.device(it.current);
    if (device == nullptr || !(device->calibrated || device->docked)) {
        return calibration::needs_person;
    }
    return device->calibrated ? calibration::done : calibration::needs_update;
}

void hdUpdateCalibration(unsigned int style)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    FakeDevice* device = it.device(it.current);
    if (device == nullptr) return;
    if (style != calibration::style_inkwell || !device->docked) {
        return it.complain(0x102, it.current);
    }
    device->calibrated = true;
}

void hdStartScheduler()
{
    Library& it = library();
    if (it.running.exchange(true)) return;
    const std::lock_guard lock{it.mutex};
    // By the vendor's reference, forces are enabled with the scheduler.
    for (FakeDevice& device : it.devices) device.force_output = true;
    it.scheduler = std::thread{run_scheduler};
}

void hdStopScheduler() { stop_scheduler(); }

void hdSetSchedulerRate(unsigned long hertz)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    if (hertz != 1000) it.complain(0x101, it.current);
}

unsigned long hdScheduleAsynchronous(Callback callback, void* data, unsigned short /*priority*/)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    if (it.callback != nullptr) {
        it.complain(0x501, no_device);
        return 0;
    }
    it.callback = callback;
    it.data = data;
    return 1;
}

void hdUnschedule(unsigned long /*scheduled*/)
{
    Library& it = library();
    const std::lock_guard lock{it.mutex};
    it.callback = nullptr;
}
}

} // namespace hapnet::device::hdapi
