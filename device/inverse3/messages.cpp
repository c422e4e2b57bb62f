// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/inverse3/messages.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device::inverse3 {

namespace {

using nlohmann::json;

// An Omni's data sheet, and its stiffness in CHAI3D's table of devices.
constexpr double omni_force_n = 3.3;
constexpr double omni_continuous_n = 0.88;
constexpr double omni_stiffness_n_per_m = 700.0;

glm::dvec3 from_service(const glm::dvec3& it) { return {it.x, it.z, -it.y}; }
glm::dvec3 to_service(const glm::dvec3& it) { return {it.x, -it.z, it.y}; }

/// Returns the member of this name; null if there is none, or if `object` is no object.
const json& member(const json& object, const char* name)
{
    static const json nothing;
    if (!object.is_object()) return nothing;
    const auto found = object.find(name);
    return found == object.end() ? nothing : *found;
}

bool flag(const json& object, const char* name, bool otherwise)
{
    const json& value = member(object, name);
    return value.is_boolean() ? value.get<bool>() : otherwise;
}

std::optional<glm::dvec3> vector_in(const json& object, const char* name)
{
    const json& value = member(object, name);
    glm::dvec3 vector{0.0};
    for (const int axis : {0, 1, 2}) {
        constexpr std::array<const char*, 3> axes{"x", "y", "z"};
        const json& part = member(value, axes.at(static_cast<std::size_t>(axis)));
        if (!part.is_number()) return std::nullopt;
        vector[axis] = part.get<double>();
    }
    if (!base::is_finite(vector)) return std::nullopt;
    return from_service(vector);
}

bool is_id(const std::string& text)
{
    return !text.empty() && text.size() <= id_bytes_max &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return c > ' ' && c <= '~' && c != '"' && c != '\\'; });
}

base::Result<DeviceState> device_in(const json& it)
{
    const json& id = member(it, "device_id");
    if (!id.is_string() || !is_id(id.get_ref<const std::string&>())) {
        return base::fail("a device without a usable device_id");
    }
    const json& state = member(it, "state");
    const auto position = vector_in(state, "cursor_position");
    const auto velocity = vector_in(state, "cursor_velocity");
    if (!position || !velocity) return base::fail("a device without a finite position");
    const json& status = member(it, "status");
    const json& axes = member(member(member(it, "config"), "basis"), "permutation");
    std::string name = id.get<std::string>();
    return DeviceState{.id = std::move(name),
                       .hip = {*position},
                       .velocity = {*velocity},
                       .calibrated = flag(status, "calibrated", false),
                       .ready = flag(status, "ready", true) && flag(status, "started", true),
                       .powered = flag(status, "power_supply", true),
                       .in_use = flag(status, "in_use", false),
                       .plain_axes = !axes.is_string() || axes == "XYZ"};
}

/// Returns the buttons of a grip: with a cable it has one button, without one three.
std::uint8_t buttons_of(const json& grips)
{
    if (!grips.is_array() || grips.empty()) return 0;
    const json& state = member(grips.front(), "state");
    const json& buttons = member(state, "buttons");
    unsigned held = flag(state, "button", false) ? 1U : 0U;
    held |= flag(buttons, "a", false) ? 1U : 0U;
    held |= flag(buttons, "b", false) ? 2U : 0U;
    held |= flag(buttons, "c", false) ? 4U : 0U;
    return static_cast<std::uint8_t>(held);
}

} // namespace

const DeviceState* ServiceState::find(std::string_view id) const
{
    const auto found = std::find_if(devices.begin(), devices.end(), [&](const DeviceState& one) {
        return id.empty() || one.id == id;
    });
    return found == devices.end() ? nullptr : &*found;
}

base::Result<ServiceState> parse_state(std::string_view text)
{
    if (text.size() > message_bytes_max) return base::fail("a message that is too long");
    const json message = json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!message.is_object()) return base::fail("a message that is no JSON object");
    ServiceState state;
    const json& devices = member(message, "inverse3");
    if (devices.is_array()) {
        if (devices.size() > devices_max) return base::fail("too many devices");
        for (const json& one : devices) {
            auto device = device_in(one);
            if (!device) return tl::unexpected{device.error()};
            state.devices.push_back(*std::move(device));
        }
    }
    state.buttons = static_cast<std::uint8_t>(buttons_of(member(message, "wireless_verse_grip")) |
                                              buttons_of(member(message, "verse_grip")));
    return state;
}

std::string force_message(std::string_view id, const polled::Command& command)
{
    const glm::dvec3 force = to_service(command.motors_on ? command.force.value : glm::dvec3{0.0});
    return fmt::format(R"({{"inverse3":[{{"device_id":"{}","commands":{{"set_cursor_force":)"
                       R"({{"vector":{{"x":{:.6f},"y":{:.6f},"z":{:.6f}}}}}}}}}]}})",
                       id, force.x, force.y, force.z);
}

polled::Report report_of(const DeviceState* device, std::uint8_t buttons)
{
    polled::Report report;
    report.buttons = buttons;
    if (device == nullptr || !device->powered) {
        report.fault = Fault::disconnected;
        return report;
    }
    report.hip = device->hip;
    report.velocity = device->velocity;
    report.calibrated = device->calibrated && device->ready;
    return report;
}

Capabilities capabilities()
{
    Capabilities can;
    // The vendor's examples have the middle at 0, -0.15, 0.19 m in its frame.
    can.workspace_min = {{-0.08, 0.12, 0.08}};
    can.workspace_max = {{0.08, 0.26, 0.22}};
    can.force_max_n = omni_force_n;
    can.force_continuous_n = omni_continuous_n;
    can.stiffness_max_n_per_m = omni_stiffness_n_per_m;
    can.resolution_m = 5.5e-5; // resolution of an Omni, as that of the device is not known
    can.speed_max_m_per_s = 1.0;
    can.buttons = 3;
    return can;
}

} // namespace hapnet::device::inverse3
