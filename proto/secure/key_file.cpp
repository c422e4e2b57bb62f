// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/key_file.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/reading.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::secure {

namespace {

using base::Node;
using base::Reading;
using base::TableReader;

constexpr std::string_view keygen_cure = "make keys with 'hapnet-peer keygen'";

Bytes text_bytes(std::string_view text) { return std::as_bytes(std::span{text}); }

std::uint8_t read_id(const Node* node, Reading& reading)
{
    if (node == nullptr) return 0;
    const auto id = base::count_of(*node, KeyFile::id_max);
    if (id && *id > 0) return static_cast<std::uint8_t>(*id);
    base::complain_of(*node, fmt::format("a number from 1 to {}", KeyFile::id_max), reading);
    return 0;
}

std::string read_text(const Node* node, Reading& reading)
{
    std::string text;
    if (node != nullptr) base::read_value(*node, text, reading);
    return text;
}

/// Reads a key. The complaint does not quote the text.
std::array<std::byte, key_bytes> read_key(const Node* node, Reading& reading)
{
    if (node == nullptr) return {};
    const auto* text = std::get_if<std::string>(&node->value);
    const auto key = text != nullptr ? key_from_base64(*text) : std::nullopt;
    if (key) return *key;
    reading.complain(
        node->place,
        fmt::format("expected 32 bytes in base 64 (44 characters, the last '='); {}", keygen_cure));
    return {};
}

KeyFile::Member read_member(const Node& node, Reading& reading)
{
    KeyFile::Member member;
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        base::complain_of(node, "a table [[peer]] with id and public", reading);
        return member;
    }
    TableReader table{*entries, node.place, reading};
    member.id = read_id(table.require("id"), reading);
    member.key = read_key(table.require("public"), reading);
    member.endpoint = read_text(table.find("endpoint"), reading);
    table.finish();
    return member;
}

void read_members(const Node* node, KeyFile& file, Reading& reading)
{
    if (node == nullptr) return;
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr) return base::complain_of(*node, "tables [[peer]]", reading);
    for (const Node& each : *list) {
        KeyFile::Member member = read_member(each, reading);
        if (!reading.is_good()) return;
        if (member.id == file.id || file.find(member.id) != nullptr) {
            reading.complain(each.place, fmt::format("id {} is there twice: every peer of a circle "
                                                     "has an id of its own",
                                                     member.id));
        } else if (!diffie_hellman(file.own, member.key)) {
            reading.complain(each.place, fmt::format("the public key of peer {} is not valid; {}",
                                                     member.id, keygen_cure));
        }
        file.others.push_back(std::move(member));
    }
    std::ranges::sort(file.others, {}, &KeyFile::Member::id);
}

KeyFile read_file(const Node& document, Reading& reading)
{
    KeyFile file;
    const auto* entries = std::get_if<Node::Table>(&document.value);
    base::ensure(entries != nullptr); // a document is a table
    TableReader table{*entries, document.place, reading};
    const Node* const name = table.require("name", "write name = \"lab\"");
    file.name = read_text(name, reading);
    const bool is_long = file.name.empty() || file.name.size() > KeyFile::name_bytes_max;
    if (name != nullptr && is_long) {
        base::complain_of(*name, fmt::format("1 to {} bytes", KeyFile::name_bytes_max), reading);
    }
    file.id = read_id(table.require("id", "write id = 1"), reading);
    file.own = Secret{read_key(table.require("secret", keygen_cure), reading)};
    if (const Node* const shared = table.find("psk")) {
        file.pre_shared = Secret{read_key(shared, reading)};
    }
    read_members(table.find("peer"), file, reading);
    table.finish();
    return file;
}

Secret read_shared(const Node& document, Reading& reading)
{
    const auto* entries = std::get_if<Node::Table>(&document.value);
    base::ensure(entries != nullptr); // a document is a table
    TableReader table{*entries, document.place, reading};
    Secret shared{read_key(table.require("psk", "write psk = \"BASE64\""), reading)};
    table.finish();
    return shared;
}

/// Returns twelve groups of five decimal digits, each the remainder of a 40-bit number.
std::string in_groups(const Hash& sum)
{
    constexpr std::size_t groups = 12, bytes = 5;
    static_assert(groups * bytes <= sizeof(Hash));
    std::string text;
    for (std::size_t group = 0; group < groups; ++group) {
        std::uint64_t number = 0;
        for (std::size_t i = 0; i < bytes; ++i)
            number = number << 8 | std::to_integer<std::uint64_t>(sum[group * bytes + i]);
        text += fmt::format("{}{:05}", group == 0 ? "" : " ", number % 100'000);
    }
    return text;
}

} // namespace

const KeyFile::Member* KeyFile::find(std::uint8_t peer) const
{
    const auto found = std::ranges::find(others, peer, &Member::id);
    return found == others.end() ? nullptr : &*found;
}

StaticKeys KeyFile::keys_with(const Member& member) const
{
    auto keys = StaticKeys::from(own.copy(), member.key, pre_shared.copy());
    base::ensure(keys.has_value()); // the parser has checked the keys
    return std::move(*keys);
}

std::array<std::byte, 8> KeyFile::circle() const
{
    const Hash all = hash(text_bytes("hapnet circle: "), text_bytes(name));
    std::array<std::byte, 8> first{};
    std::copy_n(all.begin(), first.size(), first.begin());
    return first;
}

std::string KeyFile::fingerprint() const
{
    std::vector<Member> all = others;
    all.push_back({id, public_key_of(own), {}});
    std::ranges::sort(all, {}, &Member::id);
    Hash sum = hash(text_bytes(name), hash(text_bytes("hapnet psk: "), pre_shared.bytes()));
    for (const Member& each : all) {
        sum = hash(sum, std::array{std::byte{each.id}});
        sum = hash(sum, each.key);
    }
    return in_groups(sum);
}

base::Result<KeyFile> parse_key_file(std::string_view text, const std::string& source)
{
    return base::parse_text(text, source, read_file);
}

base::Result<Secret> parse_shared_key(std::string_view text, const std::string& source)
{
    return base::parse_text(text, source, read_shared);
}

std::string print_shared_key(const Secret& key)
{
    return fmt::format("psk = \"{}\"\n", to_base64(key.bytes()));
}

std::string print_key_file(const KeyFile& file)
{
    std::string text =
        fmt::format("name = {}\nid = {}\nsecret = \"{}\"\n{}", base::quoted(file.name), file.id,
                    to_base64(file.own.bytes()), print_shared_key(file.pre_shared));
    for (const KeyFile::Member& each : file.others) {
        text += fmt::format("\n[[peer]]\nid = {}\npublic = \"{}\"\n", each.id, to_base64(each.key));
        if (!each.endpoint.empty())
            text += fmt::format("endpoint = {}\n", base::quoted(each.endpoint));
    }
    return text;
}

std::vector<KeyFile> make_circle(const std::string& name, std::uint8_t count, Entropy& entropy)
{
    base::ensure(count <= KeyFile::id_max);
    const Secret shared = entropy.secret();
    std::vector<KeyFile> files(count);
    for (std::uint8_t i = 0; i < count; ++i) {
        files[i].name = name;
        files[i].id = static_cast<std::uint8_t>(i + 1);
        files[i].own = entropy.secret();
        files[i].pre_shared = shared.copy();
    }
    for (KeyFile& file : files) {
        for (const KeyFile& other : files) {
            if (other.id != file.id)
                file.others.push_back({other.id, public_key_of(other.own), {}});
        }
    }
    return files;
}

} // namespace hapnet::secure
