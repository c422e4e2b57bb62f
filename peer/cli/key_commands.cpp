// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/key_commands.hpp"

#include "proto/base/visible.hpp"
#include "proto/cli/parsers.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/secure/key_file.hpp"
#include "proto/secure/keys/draw.hpp"
#include "proto/secure/keys/files.hpp"
#include "proto/secure/keys/process.hpp"

#include <algorithm>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace hapnet::peer {

namespace {

constexpr const char* keygen_description =
    "Makes keys for peers on different hosts. Give each host its own file and no other: by scp or "
    "a "
    "USB stick, not by mail. Only a host with such a file can move a hand.\n"
    "  keygen --peers 2 --out DIR   a file for each host: DIR/peer-1.key, DIR/peer-2.key\n"
    "  keygen --own --id 1 --out FILE   this host's file alone; the hosts then tell each other "
    "their public keys, and nothing secret travels";
constexpr const char* key_description =
    "Shows a key file, or adds a peer to it.\n"
    "  key show FILE   ids, public keys and the fingerprint, and never a secret. The fingerprint, "
    "twelve groups of five digits, is the same on all hosts that hold the same keys: compare it by "
    "telephone\n"
    "  key add FILE --id ID --public KEY   adds another host's public key, or replaces it. With "
    "--make-shared OTHER it also makes a key that the circle shares, which keeps sessions closed "
    "even to someone who records them and can compute private keys one day; on the other host, "
    "key add takes the file OTHER with --shared";
constexpr const char* key_exit_codes = R"(  0  done
  2  bad usage, or a file that is there or that cannot be used
  3  the system refused)";

base::Result<std::string> parse_path(const std::string& text)
{
    if (!text.empty() && text != "-") return text;
    return base::fail(fmt::format("'{}' is not a file: keys need one", text));
}

base::Result<std::string> parse_circle_name(const std::string& text)
{
    if (base::visible(text) != text)
        return base::fail("a name has no control characters, as it is shown on terminals");
    if (!text.empty() && text.size() <= secure::KeyFile::name_bytes_max) return text;
    return base::fail(fmt::format("a name has 1 to {} bytes", secure::KeyFile::name_bytes_max));
}

base::Result<secure::PublicKey> parse_public_key(const std::string& text)
{
    secure::prepare();
    const auto key = secure::key_from_base64(text);
    if (key) return *key;
    return base::fail(fmt::format("'{}' is not a public key: 44 characters, the last '='", text));
}

base::Result<std::string> parse_endpoint(const std::string& text)
{
    return net::parse_host_port(text).map([&text](const net::HostPort&) { return text; });
}

base::Result<void> refuse_existing(const std::vector<std::filesystem::path>& files,
                                   std::string_view option = "--out")
{
    for (const auto& file : files) {
        std::error_code trouble;
        if (std::filesystem::exists(std::filesystem::symlink_status(file, trouble)))
            return base::fail(fmt::format("{} is there: a key is never replaced; use another {}",
                                          file.string(), option));
    }
    return {};
}

std::string how_to_add(const secure::KeyFile& file)
{
    return fmt::format("hapnet-peer key add FILE --id {} --public {}", file.id,
                       secure::to_base64(secure::public_key_of(file.own)));
}

constexpr const char* no_shared_key =
    "this circle has no shared key: --make-shared OTHER makes one, --shared OTHER takes the other "
    "host's (hapnet-peer key --help)\n";

/// Puts the shared key that the command names into the file.
base::Result<void> share(const KeyAddCommand& command, secure::KeyFile& file)
{
    if (!command.make_shared.empty()) {
        if (file.has_pre_shared()) {
            return base::fail(fmt::format("--make-shared: {} has a shared key already; the other "
                                          "host needs that one",
                                          command.file));
        }
        if (auto fine = refuse_existing({command.make_shared}, "--make-shared"); !fine) return fine;
        file.pre_shared = secure::keys::draw();
        secure::keys::write_shared_key(command.make_shared, file.pre_shared);
        fmt::print("{}: the shared key, for the other host: take it there by scp or a USB stick, "
                   "use it with --shared, and remove it here and there\n",
                   command.make_shared);
    }
    if (command.shared.empty()) return {};
    auto shared = secure::keys::read_shared_key(command.shared);
    if (!shared) return tl::unexpected{shared.error()};
    file.pre_shared = *std::move(shared);
    return {};
}

/// Reads the key file, and protects the process from core dumps.
base::Result<secure::KeyFile> opened(const std::string& file)
{
    secure::keys::hide_process();
    secure::prepare();
    return secure::keys::read_key_file(file);
}

} // namespace

KeyCommands::KeyCommands(cli::Command& program)
{
    add_keygen(program);
    add_key(program);
}

void KeyCommands::add_keygen(cli::Command& program)
{
    keygen_ = &program.command("keygen", "Makes keys for peers on different hosts");
    keygen_->describe(keygen_description);
    keygen_->add_exit_codes(key_exit_codes);
    keygen_->option("--peers", "N", "A circle of N peers, 2 to 31: a file for each in --out",
                    cli::into(peers_, base::Count{2, secure::KeyFile::id_max}));
    keygen_->flag("--own", "A file for this host alone; its public key is printed", own_);
    keygen_->option("--id", "1..31", "With --own: the id of this host's peer",
                    cli::into(id_, base::Count{1, secure::KeyFile::id_max}));
    keygen_->option("--name", "NAME", "Name of the circle, the same on all its hosts (default lab)",
                    cli::into(name_, parse_circle_name));
    keygen_
        ->option("--out", "DIR|FILE", "Where the files go; with --own the file itself",
                 cli::into(out_, parse_path))
        .required("keys");
}

void KeyCommands::add_key(cli::Command& program)
{
    key_ = &program.command("key", "Shows a key file, or adds a peer to it");
    key_->describe(key_description);
    key_->add_exit_codes(key_exit_codes);
    key_->positional("show|add", "What to do", cli::into(action_, cli::one_of({"show", "add"})))
        .required("show");
    key_->positional("FILE", "A key file of this host", cli::into(file_, parse_path))
        .required("peer-1.key");
    key_->option("--id", "1..31", "With add: the id of the other peer",
                 cli::into(adding_.id, base::Count{1, secure::KeyFile::id_max}));
    key_->option("--public", "KEY", "With add: the other host's public key",
                 cli::into(adding_.key, parse_public_key));
    key_->option("--make-shared", "FILE",
                 "With add: make a shared key, and write it to FILE for the other host, too",
                 cli::into(adding_.make_shared, parse_path));
    key_->option("--shared", "FILE", "With add: take the shared key that the other host has made",
                 cli::into(adding_.shared, parse_path));
    key_->option("--endpoint", "HOST:PORT",
                 "With add: where the other peer is when neither --remote nor --peer says it",
                 cli::into(adding_.endpoint, parse_endpoint));
}

bool KeyCommands::is_chosen() const { return keygen_->is_chosen() || key_->is_chosen(); }

base::Result<KeyCommand> KeyCommands::chosen() const
{
    if (keygen_->is_chosen()) return keygen();
    const bool has_id = key_->is_given("--id"), has_public = key_->is_given("--public");
    if (action_ == "show") {
        const bool adds = has_id || has_public || key_->is_given("--endpoint") ||
                          key_->is_given("--make-shared") || key_->is_given("--shared");
        if (adds) return base::fail("key show takes a file and nothing else");
        return KeyCommand{KeyShowCommand{file_}};
    }
    if (!has_id || !has_public)
        return base::fail("key add needs --id and --public, as 'keygen --own' printed them on the "
                          "other host");
    if (key_->is_given("--make-shared") && key_->is_given("--shared"))
        return base::fail("--make-shared makes a key, --shared takes the other host's: use one");
    KeyAddCommand adding = adding_;
    adding.file = file_;
    return KeyCommand{adding};
}

base::Result<KeyCommand> KeyCommands::keygen() const
{
    if (own_ == peers_.has_value())
        return base::fail("give either --peers N for a whole circle or --own for this host");
    if (own_ && !id_) return base::fail("--own needs --id: each host of a circle has its own");
    if (!own_ && id_) return base::fail("--id is for --own: with --peers the ids are 1 to N");
    if (own_) return KeyCommand{KeygenOwnCommand{*id_, name_, out_}};
    return KeyCommand{KeygenCircleCommand{*peers_, name_, out_}};
}

base::Result<int> run(const KeygenCircleCommand& command)
{
    const std::filesystem::path folder{command.folder};
    std::vector<std::filesystem::path> paths;
    for (int id = 1; id <= command.peers; ++id)
        paths.push_back(folder / fmt::format("peer-{}.key", id));
    if (auto fine = refuse_existing(paths); !fine) return tl::unexpected{fine.error()};
    secure::keys::hide_process();
    secure::Entropy entropy{secure::keys::draw()};
    const auto files = secure::make_circle(command.name, command.peers, entropy);
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < files.size(); ++i) {
        secure::keys::write_key_file(paths[i].string(), files[i]);
        fmt::print("{}: for the host of peer {}\n", paths[i].string(), i + 1);
    }
    fmt::print("fingerprint {}\n", files.front().fingerprint());
    return 0;
}

base::Result<int> run(const KeygenOwnCommand& command)
{
    if (auto fine = refuse_existing({command.file}); !fine) return tl::unexpected{fine.error()};
    secure::keys::hide_process();
    secure::KeyFile file;
    file.name = command.name;
    file.id = command.id;
    file.own = secure::keys::draw();
    secure::keys::write_key_file(command.file, file);
    fmt::print("{}: for this host, peer {}\non the other host: {}\n", command.file, command.id,
               how_to_add(file));
    return 0;
}

base::Result<int> run(const KeyShowCommand& command)
{
    const auto file = opened(command.file);
    if (!file) return tl::unexpected{file.error()};
    fmt::print("circle {}\n", base::visible(file->name));
    fmt::print("peer {}  {}  this host\n", file->id,
               secure::to_base64(secure::public_key_of(file->own)));
    for (const secure::KeyFile::Member& each : file->others) {
        fmt::print("peer {}  {}{}\n", each.id, secure::to_base64(each.key),
                   each.endpoint.empty() ? "" : "  " + base::visible(each.endpoint));
    }
    if (!file->has_pre_shared()) fmt::print("{}", no_shared_key);
    fmt::print("fingerprint {}\n", file->fingerprint());
    return 0;
}

base::Result<int> run(const KeyAddCommand& command)
{
    auto file = opened(command.file);
    if (!file) return tl::unexpected{file.error()};
    if (command.id == file->id) {
        return base::fail(fmt::format("--id {} is this host's own in {}: the other peer has "
                                      "another one",
                                      command.id, command.file));
    }
    if (!secure::diffie_hellman(file->own, command.key))
        return base::fail("--public: this key is not valid; copy it again");
    std::erase_if(file->others, [&](const auto& each) { return each.id == command.id; });
    file->others.push_back({command.id, command.key, command.endpoint});
    std::ranges::sort(file->others, {}, &secure::KeyFile::Member::id);
    if (auto fine = share(command, *file); !fine) return tl::unexpected{fine.error()};
    secure::keys::replace_key_file(command.file, *file);
    fmt::print("{}: knows peer {}\n", command.file, command.id);
    if (!file->has_pre_shared()) fmt::print("{}", no_shared_key);
    fmt::print("fingerprint {}\n", file->fingerprint());
    return 0;
}

} // namespace hapnet::peer
