// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/host.hpp"

#include <spdlog/fmt/fmt.h>
#include <sys/utsname.h>
#include <thread>

namespace hapnet::lab {

nlohmann::ordered_json host()
{
    utsname system{};
    uname(&system);
    return {{"name", system.nodename},
            {"system", fmt::format("{} {}", system.sysname, system.release)},
            {"machine", system.machine},
            {"processors", std::thread::hardware_concurrency()}};
}

} // namespace hapnet::lab
