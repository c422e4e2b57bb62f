// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/checksums.hpp"

#include "proto/secure/primitives.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::lab {

namespace {

constexpr std::size_t checksum_bytes = 32;

std::string ended(secure::Blake2b& hash)
{
    std::array<std::byte, checksum_bytes> bytes{};
    hash.end(bytes);
    std::string digits;
    for (const std::byte byte : bytes) digits += fmt::format("{:02x}", static_cast<unsigned>(byte));
    return digits;
}

std::string checksum_of_file(const std::filesystem::path& path)
{
    constexpr std::size_t block = 1 << 20;
    std::ifstream in{path, std::ios::binary};
    secure::Blake2b hash{checksum_bytes};
    std::string text(block, '\0');
    while (in) {
        in.read(text.data(), static_cast<std::streamsize>(text.size()));
        hash.add(std::as_bytes(std::span{text}.first(static_cast<std::size_t>(in.gcount()))));
    }
    if (!in.eof())
        throw std::system_error{errno, std::generic_category(), "cannot read " + path.string()};
    return ended(hash);
}

} // namespace

std::string checksums_of(const std::filesystem::path& folder, std::vector<std::string> names)
{
    secure::prepare();
    std::ranges::sort(names);
    std::string text;
    for (const std::string& name : names)
        text += fmt::format("{}  {}\n", checksum_of_file(folder / name), name);
    return text;
}

std::string checksum_of(const std::string& text)
{
    secure::prepare();
    secure::Blake2b hash{checksum_bytes};
    return ended(hash.add(std::as_bytes(std::span{text})));
}

} // namespace hapnet::lab
