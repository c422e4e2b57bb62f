// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/checksums.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/visible.hpp"
#include "proto/net/text_file.hpp"
#include "proto/secure/primitives.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <sstream>
#include <system_error>

namespace hapnet::lab::runner {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t checksum_bytes = 32;
constexpr std::size_t line_sum_bytes = 16;
constexpr std::string_view before_sum = R"(,"sum":")", after_sum = R"("})";

template <std::size_t count>
std::string ended(secure::Blake2b& hash)
{
    std::array<std::byte, count> bytes{};
    hash.end(bytes);
    std::string digits;
    for (const std::byte byte : bytes) digits += fmt::format("{:02x}", static_cast<unsigned>(byte));
    return digits;
}

std::string checksum_of_file(const fs::path& path)
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
    return ended<checksum_bytes>(hash);
}

std::string sum_of(std::string_view text)
{
    secure::prepare();
    secure::Blake2b hash{line_sum_bytes};
    return ended<line_sum_bytes>(hash.add(std::as_bytes(std::span{text})));
}

/// Returns the digest in the manifest of a folder; "": there is none.
std::string digest_in(const fs::path& folder)
{
    const auto path = folder / "manifest.json";
    if (!fs::exists(path)) return "";
    const auto text = net::text_of_file(path.string());
    const auto manifest = nlohmann::json::parse(text.value_or(""), nullptr, false);
    if (!manifest.is_object()) return ""; // the reader of the manifest reports what is wrong
    const auto digest = manifest.find("digest");
    const bool is_said = digest != manifest.end() && digest->is_string();
    return is_said ? digest->get<std::string>() : "";
}

/// True for the name of a file below a folder, without a way out of it.
bool is_inside(const fs::path& name)
{
    return name.is_relative() && std::ranges::find(name, "..") == name.end();
}

base::Result<void> refuse(const fs::path& file, std::string_view what)
{
    return base::fail(fmt::format(
        "{} {}: copy the whole folder again, or write its results anew with hapnet-lab run or "
        "merge; without the file {} nothing is checked",
        file.string(), what, checksums_name));
}

} // namespace

std::string checksums_of(const fs::path& folder, std::vector<std::string> names)
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
    return ended<checksum_bytes>(hash.add(std::as_bytes(std::span{text})));
}

base::Result<void> verify_checksums(const fs::path& folder)
{
    const auto path = folder / checksums_name;
    if (!fs::exists(path)) return {};
    const auto text = net::text_of_file(path.string());
    if (!text) return tl::unexpected{text.error()};
    const auto digest = digest_in(folder);
    if (!digest.empty() && digest != checksum_of(*text))
        return refuse(path, "is not the one whose digest manifest.json names");
    secure::prepare();
    std::istringstream lines{*text};
    for (std::string line; std::getline(lines, line);) {
        constexpr std::size_t digits = 2 * checksum_bytes;
        if (line.size() <= digits + 2 || line.substr(digits, 2) != "  ")
            return refuse(path, "has a line that is no checksum with the name of a file");
        const fs::path name = line.substr(digits + 2);
        if (!is_inside(name))
            return refuse(path, fmt::format("names '{}', which is not below its folder",
                                            base::visible(name.string())));
        const auto file = folder / name;
        if (!fs::is_regular_file(file))
            return refuse(file, fmt::format("is missing, and {} names it", checksums_name));
        if (checksum_of_file(file) != line.substr(0, digits))
            return refuse(
                file, fmt::format("was changed: its checksum is not that in {}", checksums_name));
    }
    return {};
}

std::string with_sum(std::string object)
{
    base::ensure(object.size() > 2 && object.ends_with('}'));
    object.pop_back();
    const auto sum = sum_of(object);
    return object.append(before_sum).append(sum).append(after_sum);
}

bool has_right_sum(std::string_view line)
{
    constexpr std::size_t digits = 2 * line_sum_bytes;
    constexpr std::size_t end_size = before_sum.size() + digits + after_sum.size();
    if (line.size() <= end_size) return false;
    const auto object = line.substr(0, line.size() - end_size);
    auto end = line.substr(object.size());
    if (!end.starts_with(before_sum) || !end.ends_with(after_sum)) return false;
    return end.substr(before_sum.size(), digits) == sum_of(object);
}

} // namespace hapnet::lab::runner
