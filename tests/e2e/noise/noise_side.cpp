// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// One side of a handshake as a program, so that another implementation can be the other side. Reads
// a word and hexadecimal numbers a line, answers a line:
//     begin initiator|responder OWN OTHER SHARED PROLOGUE EPHEMERAL -> ok
//     write PAYLOAD -> the message      read MESSAGE -> its payload, or refused
//     split -> the hash of the handshake
//     seal TEXT -> sealed               open SEALED -> the text, or refused
// An empty number is written as "-".
#include "proto/secure/noise_kk.hpp"
#include "tests/unit/proto/secure/hex.hpp"

#include <iostream>
#include <optional>
#include <sstream>
#include <string>

namespace {

using namespace hapnet::secure;

class Side {
public:
    std::string answer(const std::string& line)
    {
        std::istringstream words{line};
        std::string verb;
        words >> verb;
        const auto next = [&words] {
            std::string hex;
            words >> hex;
            return from_hex(hex == "-" ? "" : hex);
        };
        if (verb == "begin") {
            std::string role;
            words >> role;
            const auto secret = [&next] {
                return Secret{std::span<const std::byte, key_bytes>{next()}};
            };
            Secret own = secret();
            const PublicKey other = public_from_hex(to_hex(next()));
            keys_ = StaticKeys::from(std::move(own), other, secret());
            if (!keys_) return "refused";
            const Text prologue = next();
            handshake_.emplace(role == "initiator" ? Role::initiator : Role::responder, *keys_,
                               prologue, secret());
            return "ok";
        }
        if (verb == "write") {
            handshake_->write(next());
            return run() ? shown(handshake_->message()) : "refused";
        }
        if (verb == "read") {
            handshake_->read(next());
            return run() ? shown(handshake_->payload()) : "refused";
        }
        if (verb == "split") {
            transport_ = handshake_->split();
            return to_hex(transport_->handshake);
        }
        Text text = next();
        if (verb == "seal") {
            text.resize(text.size() + tag_bytes);
            seal(transport_->to_other, sealed_++, {}, text);
            return to_hex(text);
        }
        if (verb != "open" || !open(transport_->from_other, opened_++, {}, text)) return "refused";
        text.resize(text.size() - tag_bytes);
        return shown(text);
    }

private:
    static std::string shown(Bytes bytes) { return bytes.empty() ? "-" : to_hex(bytes); }

    bool run()
    {
        for (;;) {
            const auto progress = handshake_->step();
            if (progress != NoiseKk::Progress::working) return progress == NoiseKk::Progress::done;
        }
    }

    std::optional<StaticKeys> keys_;
    std::optional<NoiseKk> handshake_;
    std::optional<NoiseKk::TransportKeys> transport_;
    std::uint64_t sealed_ = 0, opened_ = 0;
};

} // namespace

int main()
{
    prepare();
    Side side;
    for (std::string line; std::getline(std::cin, line);) {
        std::cout << side.answer(line) << std::endl;
    }
}
