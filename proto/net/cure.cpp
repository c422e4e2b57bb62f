// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/cure.hpp"

#include <cerrno>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::net {

namespace {

std::string_view cure_of(const std::error_code& error)
{
    if (std::string_view{error.category().name()} == "name lookup") {
        return "check the spelling, or write an IP address; an address to listen on and the one "
               "that it sends to must be both IPv4 or both IPv6";
    }
    if (error.category() != std::generic_category() && error.category() != std::system_category()) {
        return ""; // its message names the cure
    }
    switch (error.value()) {
    case EADDRINUSE:
        return "another program has it: stop that, or choose another port (0: any free one)";
    case EEXIST:
    case ENAMETOOLONG: return "choose another path";
    case EADDRNOTAVAIL:
        return "this machine has no such address: 'ip address' lists them, 0.0.0.0 is all of them";
    case EACCES:
    case EPERM: return "choose a port above 1023, or another place, or run with the permission";
    case ENOENT:
    case ENOTDIR: return "choose a path in a folder that exists";
    case EISDIR: return "name a file, not a folder";
    case EFBIG: return "raise the limit for files with 'ulimit -f unlimited'";
    case ENOSPC:
    case EDQUOT: return "make room, or choose a place on another disk";
    case ENETUNREACH:
    case EHOSTUNREACH:
        return "there is no route: check the address, and the network with 'ip route'";
    default: return "";
    }
}

std::string_view connection_cure(int error)
{
    switch (error) {
    case ENOENT:
    case ECONNREFUSED: return "start the emulator or the peer with --control and this path";
    case EACCES: return "only the user who started the program may control it";
    default: return "name the --control of an emulator or a peer";
    }
}

} // namespace

std::string explained(const std::system_error& error)
{
    const auto cure = cure_of(error.code());
    return cure.empty() ? error.what() : fmt::format("{}; {}", error.what(), cure);
}

std::string explained_connection(const std::system_error& error)
{
    return fmt::format("{}; {}", error.what(), connection_cure(error.code().value()));
}

} // namespace hapnet::net
