// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/hdapis.hpp"

#include "device/hdapi/stylus.hpp"
#include "device/hdapi/transport/configuration.hpp"
#include "device/hdapi/transport/scheduler.hpp"
#include "device/hdapi/transport/shared_library.hpp"
#include "device/transport/usb_models.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device::hdapi {

namespace {

constexpr std::array default_names{"", "Default Device", "Default PHANToM"};

/// A device behind libHD. No function here waits: the scheduler's callback makes all calls of the
/// library, and only the newest values are exchanged between it and the caller.
class LibraryDevice final : public Device {
public:
    LibraryDevice(Scheduler& scheduler, Opening opening)
        : scheduler_{scheduler},
          opening_{std::move(opening)},
          identity_{.backend = "hdapi",
                    .serial = opening_.name,
                    .model = fmt::format("{}{}{} behind libHD", opening_.model,
                                         opening_.serial.empty() ? "" : " ", opening_.serial),
                    .note = std::string{never_run}},
          capabilities_{capabilities_of(opening_.properties)},
          style_{preferred_style(opening_.properties.calibration_styles)},
          stylus_{style_}
    {}
    ~LibraryDevice() override { scheduler_.close(opening_); }
    LibraryDevice(const LibraryDevice&) = delete;
    LibraryDevice& operator=(const LibraryDevice&) = delete;

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] CalibrationStep calibrate(base::TimePoint /*now*/) override
    {
        return calibration_step(opening_.client->report().calibration, style_);
    }
    [[nodiscard]] Sample read(base::TimePoint now) override
    {
        return stylus_.read(opening_.client->report(), now);
    }
    void apply(const GovernedForce& force) override
    {
        const base::Force& it = force.force();
        opening_.client->command({{it.x(), it.y(), it.z()}, force.motors_on()});
    }
    void halt() noexcept override { opening_.client->halt(); }
    void pace(const std::function<bool()>& beat) override { opening_.client->pace(beat); }

private:
    Scheduler& scheduler_;
    Opening opening_;
    Identity identity_;
    Capabilities capabilities_;
    int style_;
    Stylus stylus_;
};

Identity identity_of(const std::string& name, std::string model)
{
    return {.backend = "hdapi",
            .serial = name,
            .model = std::move(model),
            .note = std::string{never_run}};
}

} // namespace

Opened<std::vector<std::unique_ptr<Device>>> open_hdapis(const std::vector<std::string>& names,
                                                         const std::string& library)
{
    const auto scheduler = scheduler_of(library);
    if (!scheduler) return tl::unexpected{scheduler.error()};
    auto openings = (*scheduler)->open(names);
    if (!openings) return tl::unexpected{openings.error()};
    std::vector<std::unique_ptr<Device>> devices;
    for (Opening& opening : *openings) {
        devices.push_back(std::make_unique<LibraryDevice>(**scheduler, std::move(opening)));
    }
    return devices;
}

Opened<std::unique_ptr<Device>> open_hdapi(const std::string& name, const std::string& library)
{
    const auto open = [&](const std::string& one) { return open_hdapis({one}, library); };
    auto devices = open(name);
    if (name.empty()) {
        for (const char* other : default_names) {
            if (devices || devices.error().fault != Fault::not_found) break;
            devices = open(other);
        }
    }
    if (!devices) return tl::unexpected{devices.error()};
    return std::move(devices->front());
}

std::vector<Found> find_hdapis(const std::string& library)
{
    std::vector<Found> found;
    for (const std::string& name : configured_names()) {
        found.push_back({identity_of(name, "device in the configuration of 3D Systems"), {}});
    }
    for (std::string& model : models_on_usb(UsbKind::touch)) {
        if (found.empty()) found.push_back({identity_of("", std::move(model)), {}});
    }
    if (found.empty() && library.empty()) return found; // no sign of a device
    const auto functions = load_library(library);
    if (found.empty()) found.push_back({identity_of("", "default device of libHD"), {}});
    if (functions) return found;
    for (Found& one : found) one.unusable = functions.error();
    return found;
}

} // namespace hapnet::device::hdapi
