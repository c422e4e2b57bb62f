// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/secure/key_file.hpp"

#include "tests/unit/proto/secure/circle.hpp"

#include <gtest/gtest.h>
#include <set>

namespace hapnet::secure {

namespace {

std::vector<KeyFile> three()
{
    Entropy entropy{circle::secret_of(5)};
    return make_circle("lab", 3, entropy);
}

std::string complaint_about(const std::string& text)
{
    const auto file = parse_key_file(text, "peer.key");
    return file ? "" : file.error().message;
}

std::string replaced(std::string text, std::string_view from, std::string_view to)
{
    return text.replace(text.find(from), from.size(), to);
}

} // namespace

TEST(KeyFile, ReadsBackAsItWasPrinted)
{
    for (KeyFile& file : three()) {
        file.others.front().endpoint = "10.0.0.2:7000";
        const std::string text = print_key_file(file);
        const auto again = parse_key_file(text, "peer.key");
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(print_key_file(*again), text);
        EXPECT_EQ(again->others.front().endpoint, "10.0.0.2:7000");
    }
}

TEST(KeyFile, OfACircleHoldsItsOwnSecretAndEverybodysPublicKey)
{
    const auto files = three();
    EXPECT_NE(to_hex(files[0].own.bytes()), to_hex(files[1].own.bytes()));
    EXPECT_EQ(to_hex(files[0].pre_shared.bytes()), to_hex(files[1].pre_shared.bytes()));
    ASSERT_NE(files[0].find(2), nullptr);
    EXPECT_EQ(files[0].find(2)->key, public_key_of(files[1].own));
    EXPECT_EQ(files[0].find(1), nullptr);
    EXPECT_EQ(files[0].circle(), files[2].circle());
}

TEST(KeyFile, HasAFingerprintThatTellsAnyOtherKeyApart)
{
    auto files = three();
    const std::string fingerprint = files[0].fingerprint();
    EXPECT_EQ(fingerprint.size(), 12U * 6U - 1U);
    for (std::size_t i = 0; i < fingerprint.size(); ++i) {
        const bool is_digit = fingerprint[i] >= '0' && fingerprint[i] <= '9';
        EXPECT_TRUE(i % 6 == 5 ? fingerprint[i] == ' ' : is_digit) << fingerprint;
    }
    EXPECT_EQ(files[1].fingerprint(), fingerprint);
    EXPECT_EQ(files[2].fingerprint(), fingerprint);
    files[1].others.back().key[7] ^= std::byte{1};
    EXPECT_NE(files[1].fingerprint(), fingerprint);
    files[2].pre_shared = Secret{};
    EXPECT_NE(files[2].fingerprint(), fingerprint);
}

TEST(KeyFile, GivesBothSidesWhatTheyNeedToMeet)
{
    const auto files = three();
    const StaticKeys a = files[0].keys_with(*files[0].find(3));
    const StaticKeys b = files[2].keys_with(*files[2].find(1));
    EXPECT_EQ(to_hex(a.common().bytes()), to_hex(b.common().bytes()));
    EXPECT_EQ(a.own_public(), b.other());
}

TEST(KeyFile, IsRefusedWithTheLineAndTheCureAndWithoutTheSecret)
{
    const std::string text = print_key_file(three()[0]);
    const std::string secret = text.substr(text.find("secret = \"") + 10, 44);
    EXPECT_EQ(complaint_about(replaced(text, "id = 1", "id = 0")),
              "peer.key:2:6: expected a number from 1 to 31, not 0");
    EXPECT_EQ(complaint_about(replaced(text, "id = 2", "id = 3")),
              "peer.key:10:1: id 3 is there twice: every peer of a circle has an id of its own");
    EXPECT_EQ(complaint_about(replaced(text, "id = 2", "id = 1")),
              "peer.key:6:1: id 1 is there twice: every peer of a circle has an id of its own");
    for (const char* wrong : {"", "x", "====", "AAAA"}) {
        const std::string complaint = complaint_about(replaced(text, secret, wrong));
        EXPECT_EQ(complaint, "peer.key:3:10: expected 32 bytes in base 64 (44 characters, the last "
                             "'='); make keys with 'hapnet-peer keygen'");
    }
    const std::string spoilt = complaint_about(replaced(text, secret, '-' + secret.substr(1)));
    EXPECT_EQ(spoilt.find(secret.substr(1, 8)), std::string::npos);
    EXPECT_NE(spoilt, "");
    EXPECT_NE(complaint_about(replaced(text, "name", "nane")).find("did you mean 'name'"),
              std::string::npos);
    EXPECT_EQ(complaint_about("name = \"lab\"\nid = 1\n"),
              "peer.key:1:1: missing key 'secret': make keys with 'hapnet-peer keygen'");
}

TEST(KeyFile, HasAFingerprintOfWhichEveryDigitDependsOnEveryKey)
{
    auto files = three();
    std::vector<std::string> seen;
    for (int i = 0; i < 40; ++i) {
        files[0].others.front().key[3] = static_cast<std::byte>(i);
        seen.push_back(files[0].fingerprint());
    }
    for (std::size_t digit = 0; digit < seen.front().size(); ++digit) {
        if (digit % 6 == 5) continue;
        std::set<char> found;
        for (const std::string& each : seen) found.insert(each.at(digit));
        EXPECT_GE(found.size(), 7U) << digit; // of ten; fewer once in 50 000
    }
}

TEST(KeyFile, RefusesAPublicKeyOfLowOrderAndOneThatIsNotCanonical)
{
    const auto files = three();
    PublicKey with_high_bit = public_key_of(files[1].own);
    with_high_bit.back() |= std::byte{0x80};
    PublicKey prime_and_nine{}; // another way to write 9
    prime_and_nine.fill(std::byte{0xff});
    prime_and_nine.front() = std::byte{0xed + 9};
    prime_and_nine.back() = std::byte{0x7f};
    const std::string text = print_key_file(files[0]);
    const std::size_t key = text.find("public = \"") + 10;
    for (const PublicKey& wrong : {PublicKey{}, with_high_bit, prime_and_nine}) {
        EXPECT_EQ(complaint_about(std::string{text}.replace(key, 44, to_base64(wrong))),
                  "peer.key:6:1: the public key of peer 2 is not valid; make keys with "
                  "'hapnet-peer keygen'");
    }
}

TEST(Entropy, RepeatsItselfFromTheSameSecretAndNeverElse)
{
    Entropy a{circle::secret_of(1)}, b{circle::secret_of(1)}, c{circle::secret_of(2)};
    const std::string first = to_hex(a.secret().bytes());
    EXPECT_EQ(to_hex(b.secret().bytes()), first);
    EXPECT_NE(to_hex(a.secret().bytes()), first);
    EXPECT_NE(to_hex(c.secret().bytes()), first);
    EXPECT_NE((a.bytes<4>()), (a.bytes<4>()));
}

} // namespace hapnet::secure
