// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/commands.hpp"

#include "peer/cli/list_devices.hpp"
#include "peer/doctor/report.hpp"
#include "peer/doctor/system.hpp"
#include "proto/net/program.hpp"
#include "proto/secure/keys/files.hpp"
#include "proto/secure/keys/process.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

base::Result<int> run(const ListDevicesCommand& command)
{
    const auto found = device::find_devices(command.options);
    net::print(command.json ? device_json(found) : device_table(found));
    return 0;
}

base::Result<int> run(const DoctorCommand& command)
{
    doctor::Facts facts = doctor::look_at("/", command.hd_library);
    if (command.key) {
        secure::keys::hide_process();
        secure::prepare();
        const auto file = secure::keys::read_key_file(*command.key);
        facts.key = {*command.key, file ? std::string{} : file.error().message};
    }
    const auto examined = doctor::examine(facts);
    net::print(command.json ? doctor::json_text_of(examined) : doctor::text_of(examined));
    return examined.has_bad ? net::exit_environment : 0;
}

base::Result<int> run(const KeyCommand& command)
{
    return std::visit([](const auto& chosen) { return run(chosen); }, command);
}

} // namespace hapnet::peer
