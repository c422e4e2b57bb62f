// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/keys/files.hpp"

#include "proto/disk/create.hpp"
#include "proto/disk/private_file.hpp"
#include "proto/disk/result_file.hpp"

#include <cerrno>
#include <fcntl.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace hapnet::secure::keys {

namespace {

constexpr std::size_t bytes_max = std::size_t{64} << 10;
constexpr mode_t for_this_user = 0600;

/// A text that is overwritten before its memory is freed.
class SecretText {
public:
    explicit SecretText(std::string text) : text_{std::move(text)} {}
    SecretText(const SecretText&) = delete;
    SecretText& operator=(const SecretText&) = delete;
    ~SecretText() { wipe(std::as_writable_bytes(std::span{text_})); }
    [[nodiscard]] const std::string& text() const { return text_; }

private:
    std::string text_;
};

/// Writes a new file.
void write_new(const std::string& path, std::string text)
{
    const SecretText secret{std::move(text)};
    const auto fail = [&path](std::error_code error) {
        throw std::system_error{error, fmt::format("cannot write {}", path)};
    };
    const auto place = disk::Place::find(path, disk::Place::LastLink::kept);
    if (!place) return fail(place.error());
    const auto created = disk::create(*place, O_WRONLY, for_this_user);
    if (!created) return fail(created.error());
    auto error = disk::write_all(created->number(), secret.text()).error;
    if (!error && fsync(created->number()) != 0) error = {errno, std::generic_category()};
    if (!error) return;
    unlinkat(place->folder(), place->name().c_str(), 0);
    fail(error);
}

/// Parses the text of a file that only its owner can read, and returns the result of `parse`.
template <typename Parse>
std::invoke_result_t<Parse, std::string_view> read_secret(const std::string& path, Parse parse)
{
    auto read = disk::read_private(path, {.name = "key file", .bytes_max = bytes_max});
    if (!read) return tl::unexpected{std::move(read).error()};
    const SecretText secret{*std::move(read)};
    return parse(std::string_view{secret.text()});
}

} // namespace

base::Result<KeyFile> read_key_file(const std::string& path)
{
    return read_secret(path, [&](std::string_view text) { return parse_key_file(text, path); });
}

base::Result<Secret> read_shared_key(const std::string& path)
{
    return read_secret(path, [&](std::string_view text) { return parse_shared_key(text, path); });
}

void write_key_file(const std::string& path, const KeyFile& file)
{
    write_new(path, print_key_file(file));
}

void write_shared_key(const std::string& path, const Secret& key)
{
    write_new(path, print_shared_key(key));
}

void replace_key_file(const std::string& path, const KeyFile& file)
{
    const SecretText secret{print_key_file(file)};
    disk::ResultFile{path, "", for_this_user}.commit_to_disk(secret.text());
}

} // namespace hapnet::secure::keys
