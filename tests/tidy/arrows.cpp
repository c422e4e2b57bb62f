// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/tidy/arrows.hpp"

#include <algorithm>
#include <array>

namespace hapnet::tidy {

namespace {

struct Folder {
    std::string_view name;
    bool is_core;
    std::vector<std::string_view> arrows;
};

/// The map. A folder comes before the one that it lies in.
const std::vector<Folder>& map()
{
    static const std::vector<Folder> folders{
        {"proto/base", true, {}},
        {"proto/cli", false, {"proto/base"}},
        {"proto/output", true, {"proto/base"}},
        {"proto/page", true, {"proto/base"}},
        {"proto/wire", true, {"proto/base"}},
        {"proto/disk", false, {"proto/base"}},
        {"proto/secure/keys", false, {"proto/secure", "proto/disk"}},
        {"proto/secure", true, {"proto/base"}},
        {"proto/record", false, {"proto/disk"}},
        {"proto/telemetry", true, {"proto/record", "proto/wire"}},
        {"proto/net", false, {"proto/disk"}},
        {"proto/control/core", true, {"proto/base"}},
        {"proto/control", false, {"proto/control/core", "proto/net"}},
        {"scene", true, {"proto/base"}},
        {"emulator/core", true, {"proto/base"}},
        {"emulator/tools", true, {"emulator/core", "proto/output", "proto/page"}},
        {"emulator/abi", false, {"emulator/core", "proto/net"}},
        {"emulator/control", true, {"emulator/core", "proto/control/core", "proto/output"}},
        {"emulator", false, {"emulator/tools", "emulator/control", "proto/control", "proto/cli"}},
        {"ctl", false, {"proto/output", "proto/net", "proto/cli"}},
        {"device/catalogue",
         false,
         {"device/dhd/transport", "device/falcon/transport", "device/hdapi/transport",
          "device/hid/transport", "device/inverse3/transport", "device/omni1394/transport",
          "device"}},
        {"device/transport", false, {"device", "proto/net"}},
        {"device/dhd/transport", false, {"device/transport"}},
        {"device/falcon/transport", false, {"device"}},
        {"device/hdapi/transport", false, {"device/transport"}},
        {"device/hid/transport", false, {"device", "proto/net"}},
        {"device/inverse3/transport", false, {"device/transport"}},
        {"device/omni1394/transport", false, {"device"}},
        {"device", true, {"proto/base"}},
        {"peer/core", true, {"scene", "proto/wire", "proto/record", "device"}},
        {"peer/line", true, {"proto/wire", "proto/secure"}},
        {"peer/control",
         true,
         {"peer/core", "proto/control/core", "proto/output", "proto/telemetry"}},
        {"peer/shared_object", false, {"peer/core", "proto/net"}},
        {"peer",
         false,
         {"peer/core", "peer/shared_object", "peer/line", "peer/control", "device/catalogue",
          "proto/output", "proto/record", "proto/secure/keys", "proto/telemetry", "proto/control",
          "proto/cli"}},
        {"web/core", true, {"proto/control/core"}},
        {"web", false, {"web/core", "proto/output", "proto/net", "proto/cli"}},
        {"lab/cli",
         false,
         {"lab/runner", "peer/shared_object", "proto/cli", "proto/control", "proto/output"}},
        {"lab/runner", false, {"lab", "proto/net"}},
        {"lab",
         true,
         {"emulator/tools", "emulator/control", "peer/core", "peer/line", "peer/control",
          "proto/page", "proto/record", "proto/telemetry", "device"}},
    };
    return folders;
}

bool is_impure(std::string_view header)
{
    constexpr std::array headers{"condition_variable",
                                 "csignal",
                                 "cstdio",
                                 "ctime",
                                 "filesystem",
                                 "fstream",
                                 "future",
                                 "iostream",
                                 "mutex",
                                 "netdb.h",
                                 "poll.h",
                                 "pthread.h",
                                 "random",
                                 "sched.h",
                                 "signal.h",
                                 "stdio.h",
                                 "stop_token",
                                 "syncstream",
                                 "thread",
                                 "time.h",
                                 "unistd.h",
                                 "semaphore",
                                 "fcntl.h"};
    constexpr std::array folders{"sys/", "arpa/", "netinet/", "linux/", "readerwriterqueue/"};
    if (header.starts_with("spdlog/")) return !header.starts_with("spdlog/fmt/");
    return std::find(headers.begin(), headers.end(), header) != headers.end() ||
           std::any_of(folders.begin(), folders.end(),
                       [&](const char* folder) { return header.starts_with(folder); });
}

} // namespace

std::string folder_of(std::string_view path)
{
    for (const Folder& folder : map()) {
        if (path.starts_with(std::string{folder.name} + "/")) return std::string{folder.name};
    }
    return "";
}

bool may_include(std::string_view from, std::string_view to)
{
    if (from == to) return true;
    const auto folder = std::find_if(map().begin(), map().end(),
                                     [&](const Folder& one) { return one.name == from; });
    return folder != map().end() &&
           std::any_of(folder->arrows.begin(), folder->arrows.end(),
                       [&](std::string_view next) { return may_include(next, to); });
}

std::vector<std::string> wrong_arrows(const SourceFile& file)
{
    std::vector<std::string> complaints;
    const std::string from = folder_of(file.path);
    if (!file.is_cpp() || (from.empty() && !file.is_in("tests"))) return complaints;
    for (const auto& [path, is_quoted] : includes_of(file)) {
        if (!is_quoted || path == "hapnet_commit.hpp") continue;
        const std::string to = folder_of(path);
        if (to.empty() && !(from.empty() && path.starts_with("tests/"))) {
            complaints.push_back(path + ": not a path from the root into a folder of the map");
        } else if (!from.empty() && !may_include(from, to)) {
            complaints.push_back(path + ": no arrow leads from " + from + " to " + to);
        }
    }
    return complaints;
}

std::vector<std::string> impure_includes(const SourceFile& file)
{
    std::vector<std::string> complaints;
    const std::string from = folder_of(file.path);
    const bool is_core = std::any_of(map().begin(), map().end(), [&](const Folder& folder) {
        return folder.name == from && folder.is_core;
    });
    // The one function that prints and aborts when our own code is wrong.
    if (!is_core || file.path == "proto/base/ensure.hpp") return complaints;
    for (const Include& include : includes_of(file)) {
        if (!is_impure(include.path)) continue;
        complaints.push_back(include.path + ": a core does no I/O, reads no clock, has no thread");
    }
    return complaints;
}

} // namespace hapnet::tidy
