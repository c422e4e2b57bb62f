// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/commands.hpp"

#include "peer/cli/list_devices.hpp"
#include "peer/doctor/report.hpp"
#include "peer/doctor/system.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

base::Result<int> run(const ListDevicesCommand& command)
{
    const auto found = device::find_devices(command.options);
    fmt::print("{}", command.json ? device_json(found) : device_table(found));
    return 0;
}

base::Result<int> run(const DoctorCommand& command)
{
    const auto findings = doctor::judge(doctor::look_at("/", command.hd_library));
    fmt::print("{}",
               command.json ? doctor::finding_json(findings) : doctor::finding_table(findings));
    return doctor::has_bad(findings) ? net::exit_environment : 0;
}

base::Result<int> run(const KeyCommand& command)
{
    return std::visit([](const auto& chosen) { return run(chosen); }, command);
}

} // namespace hapnet::peer
