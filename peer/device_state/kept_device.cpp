// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/device_state/kept_device.hpp"

#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <cstdlib>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::peer::device_state {

namespace {

namespace fs = std::filesystem;

/// Returns the folder by the XDG Base Directory Specification, which ignores relative paths; "" if
/// the environment names none.
std::string folder()
{
    const char* state = std::getenv("XDG_STATE_HOME");
    if (state != nullptr && state[0] == '/') return fmt::format("{}/hapnet/device", state);
    const char* home = std::getenv("HOME");
    if (home == nullptr || home[0] != '/') return "";
    return fmt::format("{}/.local/state/hapnet/device", home);
}

void say(std::string_view text) { net::say("hapnet-peer", text); }

} // namespace

KeptDevice::KeptDevice(const device::Identity& identity, std::string_view place)
{
    const std::string where = folder();
    if (where.empty()) return;
    path_ = where + '/' + file_name(identity, place);
    std::error_code none;
    if (!fs::exists(path_, none)) return;
    const auto text = net::text_of_file(path_);
    const auto state = text ? parse(*text) : tl::unexpected{text.error()};
    if (state) {
        state_ = *state;
    } else {
        say(fmt::format("{}: {}: it is not used", path_, state.error().message));
    }
}

std::string_view KeptDevice::why_untested() const
{
    return device_state::why_untested(state_, net::wall_clock_seconds());
}

double KeptDevice::heat_at_start(base::Duration heat_time) const
{
    const double now_s = net::wall_clock_seconds();
    return device_state::heat_at_start(state_, {now_s, now_s - base::to_seconds(net::since_boot())},
                                       heat_time);
}

void KeptDevice::on_use()
{
    state_.heat.reset();
    save();
}

void KeptDevice::on_rest(double heat)
{
    state_.heat = DeviceState::Heat{heat, net::wall_clock_seconds()};
    save();
}

void KeptDevice::on_passed()
{
    state_.self_test_passed_s = net::wall_clock_seconds();
    save();
}

void KeptDevice::save()
{
    if (path_.empty()) return;
    try {
        fs::create_directories(fs::path{path_}.parent_path());
        disk::ResultFile file{path_, "", 0600};
        file.commit(to_text(state_));
    } catch (const std::system_error& error) {
        say(fmt::format("what is known of the device cannot be kept: {}", error.what()));
    }
}

} // namespace hapnet::peer::device_state
