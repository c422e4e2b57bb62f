// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/cure.hpp"

#include <cerrno>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::net {

namespace {

/// System errors about addresses. The messages are those of the system.
class AddressErrors : public std::error_category {
public:
    [[nodiscard]] const char* name() const noexcept override { return "address"; }
    [[nodiscard]] std::string message(int error) const override
    {
        return std::generic_category().message(error);
    }
    [[nodiscard]] std::error_condition default_error_condition(int error) const noexcept override
    {
        return {error, std::generic_category()};
    }
};

constexpr std::string_view no_route =
    "there is no route: check the address, and the network with 'ip route'";

std::string_view cure_of_binding(int error)
{
    switch (error) {
    case EADDRINUSE:
        return "another program has it: stop that, or choose another port (0: any free one)";
    case EADDRNOTAVAIL:
        return "this machine has no such address: 'ip address' lists them, 0.0.0.0 is all of them";
    case EACCES:
    case EPERM: return "ports below 1024 belong to root: choose a port above 1023";
    case ENETUNREACH:
    case EHOSTUNREACH: return no_route;
    default: return "";
    }
}

std::string_view cure_of_reaching(int error)
{
    switch (error) {
    case EACCES: return "this is a broadcast address, or a firewall forbids it: name one host";
    case EADDRNOTAVAIL: return "this is no address of a host: check it";
    case ENETUNREACH:
    case EHOSTUNREACH: return no_route;
    default: return "";
    }
}

/// Returns the advice for an error with a file, a folder, or a permission.
std::string_view cure_of_place(int error)
{
    switch (error) {
    case EADDRINUSE: return "another program has it: stop that, or choose another";
    case EEXIST:
    case ENAMETOOLONG: return "choose another path";
    case EACCES: return "choose a folder of yours, or run this as a user who may";
    case EPERM: return "run this as root, or as a user who may do this";
    case EROFS: return "this place is read-only: choose a folder elsewhere";
    case ENOENT:
    case ENOTDIR: return "choose a path in a folder that exists";
    case EISDIR: return "name a file, not a folder";
    case ELOOP: return "symbolic links lead in a circle there: choose another path";
    case EMFILE: return "raise the limit of open files with 'ulimit -n 4096'";
    case EFBIG: return "raise the limit for files with 'ulimit -f unlimited'";
    case ENOSPC:
    case EDQUOT: return "make room, or choose a place on another disk";
    case ENETUNREACH:
    case EHOSTUNREACH: return no_route;
    default: return "";
    }
}

std::string_view cure_of(const std::error_code& error)
{
    if (std::string_view{error.category().name()} == "name lookup") {
        return "check the spelling, or write an IP address; an address to listen on and the one "
               "that it sends to must be both IPv4 or both IPv6";
    }
    if (error.category() == errors_of(AddressUse::bind)) return cure_of_binding(error.value());
    if (error.category() == errors_of(AddressUse::reach)) return cure_of_reaching(error.value());
    if (error.category() != std::generic_category() && error.category() != std::system_category()) {
        return ""; // the message of the error names the cure
    }
    return cure_of_place(error.value());
}

std::string_view connection_cure(int error)
{
    switch (error) {
    case ENOENT:
    case ECONNREFUSED: return "start the emulator or the peer with --control and this path";
    case ENOTSOCK: return "name the --control of an emulator or a peer";
    case EACCES: return "only the user who started the program may control it";
    default: return "name the --control of an emulator or a peer";
    }
}

} // namespace

const std::error_category& errors_of(AddressUse use)
{
    static const AddressErrors bind, reach; // two kinds: categories are told apart by address
    return use == AddressUse::bind ? bind : reach;
}

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
