// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/terminal_line.hpp"

#include "proto/base/visible.hpp"
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

namespace {

constexpr std::string_view erase = "\r\x1b[K";

std::size_t columns_of(int descriptor)
{
    winsize size{};
    if (ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::string::npos;
    return size.ws_col;
}

} // namespace

TerminalLine::TerminalLine(int descriptor)
    : descriptor_{descriptor}, is_terminal_{isatty(descriptor) != 0}
{}

std::string TerminalLine::shown(std::string_view text)
{
    is_open_ = true;
    return std::string{erase} + base::visible(text).substr(0, columns_of(descriptor_));
}

std::string TerminalLine::room()
{
    return std::exchange(is_open_, false) ? std::string{erase} : std::string{};
}

std::string TerminalLine::left() { return std::exchange(is_open_, false) ? "\n" : ""; }

} // namespace hapnet::net
