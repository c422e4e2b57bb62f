// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/ping.hpp"

#include "proto/base/lines.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

/// The delays in ms; -1: lost.
std::vector<double> told(const std::string& text)
{
    EXPECT_TRUE(is_ping(text)) << text;
    const auto read = read_ping(text);
    if (!read) {
        ADD_FAILURE() << text << read.error().message;
        return {};
    }
    std::vector<double> delays;
    for (std::size_t i = 0; i < read->round_trip->lost.size(); ++i) {
        const auto& delay = read->round_trip->delays[i];
        delays.push_back(delay ? std::chrono::duration<double, std::milli>{*delay}.count() : -1.0);
    }
    return delays;
}

using Delays = std::vector<double>;

/// Five questions of iputils, of which the second and the last have no answer.
std::string iputils(const std::string& bytes_from, const std::string& number,
                    const std::string& life, const std::string& time, const std::string& unit)
{
    const auto line = [&](int n, const std::string& ms) {
        return bytes_from + number + std::to_string(n) + life + "57" + time + ms + unit + "\n";
    };
    return line(1, "20.5") + line(3, "21,25") + line(4, "19");
}

TEST(ReadPing, ReadsIputilsInEachLanguageThatItSpeaks)
{
    const Delays expected{20.5, -1, 21.25, 19, -1};
    struct Language {
        std::string header, lines, summary;
    };
    // Words as in iputils' translations: for the time and its unit, and the order of the summary.
    for (
        const auto& [header, lines, summary] : std::vector<Language>{
            {"PING h (192.0.2.7) 56(84) bytes of data.\n",
             iputils("64 bytes from 192.0.2.7:", " icmp_seq=", " ttl=", " time=", " ms"),
             "--- h ping statistics ---\n5 packets transmitted, 3 received, 40% packet loss, time "
             "4012ms\n"},
            {"PING h (192.0.2.7) 56(84) Bytes an Daten.\n",
             iputils("64 Bytes von 192.0.2.7:", " icmp_seq=", " ttl=", " Zeit=", " ms"),
             "--- h ping-Statistiken ---\n5 Pakete übertragen, 3 empfangen, 40% Paketverlust, Zeit "
             "4012ms\n"},
            {"PING h (192.0.2.7) 56(84) octets de données.\n",
             iputils("64 octets de 192.0.2.7 :", " icmp_seq=", " ttl=", " temps=", " ms"),
             "--- statistiques ping h ---\n5 paquets transmis, 3 reçus, 40 % paquets perdus, temps "
             "4012 ms\n"},
            {"PING h (192.0.2.7) 56(84) バイトのデータ\n",
             iputils("64 バイト応答 送信元 192.0.2.7:", " icmp_seq=", " ttl=", " 時間=", " ミリ秒"),
             "--- h ping 統計 ---\n送信パケット数 5, 受信パケット数 3, パケット損失 40%, 時間 "
             "4012ミリ秒\n"},
            {"ПІНГ h (192.0.2.7) 56(84) байтів даних.\n",
             iputils("64 байтів від 192.0.2.7:", " icmp_seq=", " ttl=", " час=", " мс"),
             "--- Статистика пінгування h ---\nНадіслано 5 пакетів, отримано 3, втрачено 40% "
             "пакетів, час 4012 мс\n"},
            {"PING h (192.0.2.7) 56(84) bayt veri.\n",
             iputils("192.0.2.7'den 64 bayt:", " icmp_seq=", " ttl=", " zaman=", " ms"),
             "--- h ping istatistikleri ---\n5 paket iletildi, 3 alındı, %40 paket kaybı, zaman "
             "4012ms\n"},
            {"PING h (192.0.2.7) 56 (84) datových bajtů.\n",
             iputils("64 bajtů od 192.0.2.7:", " pořadí=", " TTL=", " čas=", " ms"),
             "--- Statistika pingů na h ---\n5 paketů odesláno, 3 přijato, 40% ztráta paketů, čas "
             "4012 ms\n"},
            {"PING h (192.0.2.7) 56 (84) ბაიტი მონაცემები.\n",
             iputils("64 ბაიტი 192.0.2.7-დან:", " icmp_seq =", " ttl =", " დრო=", " მწმ"),
             "--- h-ის პინგის სტატისტიკა ----\nგადაცემულია 5 პაკეტი, მიღებულია 3, 40% პაკეტი "
             "დაიკარგა, დრო 4012მწმ\n"},
            {"PING h (192.0.2.7) 56(84) tavua dataa.\n",
             iputils("64 tavua osoitteesta 192.0.2.7:", " icmp_seq=", " ttl=", " aika=", " ms"),
             "-- h ping-tilastot --\n5 paketteja lähetetty, 3 otettu vastaan, 40 % pakettihäviö, "
             "aika 4012 ms\n"}}) {
        const auto text = header + lines + "\n" + summary;
        EXPECT_EQ(told(text), expected) << text;
        EXPECT_EQ(read_ping(text)->round_trip->spacing, 1003ms) << text;
        EXPECT_EQ(told(lines), (Delays{20.5, -1, 21.25, 19})) << "without the other lines";
    }
}

TEST(ReadPing, CountsFromZeroWhereTheProgramDoes)
{
    // BusyBox, whose first question is lost.
    EXPECT_EQ(
        told("PING h (192.0.2.7): 56 data bytes\n"
             "64 bytes from 192.0.2.7: seq=1 ttl=64 time=0.5 ms\n"
             "64 bytes from 192.0.2.7: seq=2 ttl=64 time=0.75 ms\n\n--- h ping statistics ---\n"
             "4 packets transmitted, 2 packets received, 50% packet loss\n"
             "round-trip min/avg/max = 0.5/0.625/0.75 ms\n"),
        (Delays{-1, 0.5, 0.75, -1}));
    // macOS, which reports a time-out; the last one timed out, too.
    EXPECT_EQ(told("PING h (192.0.2.7): 56 data bytes\n"
                   "64 bytes from 192.0.2.7: icmp_seq=0 ttl=54 time=12.25 ms\n"
                   "Request timeout for icmp_seq 1\n"
                   "64 bytes from 192.0.2.7: icmp_seq=2 ttl=54 time=13.5 ms\n"
                   "64 bytes from 192.0.2.7: icmp_seq=2 ttl=54 time=14.5 ms (DUP!)\n"
                   "Request timeout for icmp_seq 3\n"),
              (Delays{12.25, -1, 13.5, -1}));
    // FreeBSD's ping6.
    EXPECT_EQ(told("PING6(56=40+8+8 bytes) ::1 --> ::1\n"
                   "16 bytes from ::1, icmp_seq=1 hlim=64 time=0.25 ms\n"),
              (Delays{-1, 0.25}));
    // iputils with IPv6 counts from 1, and names no second size.
    EXPECT_EQ(told("PING ::1 (::1) 56 data bytes\n"
                   "64 bytes from ::1: icmp_seq=2 ttl=64 time=0.25 ms\n"),
              (Delays{-1, 0.25}));
    // Solaris: numbers followed by a point, and no time to live.
    EXPECT_EQ(told("PING h: 56 data bytes\n64 bytes from h (192.0.2.7): icmp_seq=0. time=3.5 ms\n"
                   "64 bytes from h (192.0.2.7): icmp_seq=2. time=4. ms\n"),
              (Delays{3.5, -1, 4}));
}

TEST(ReadPing, TakesQuestionsWithoutAnAnswerAndErrorsForLosses)
{
    EXPECT_EQ(told("PING h (192.0.2.7) 56(84) bytes of data.\n"
                   "64 bytes from 192.0.2.7: icmp_seq=1 ttl=57 time=20 ms\n"
                   "From 192.0.2.254 icmp_seq=2 Destination Host Unreachable\n"
                   "no answer yet for icmp_seq=3\n"
                   "64 bytes from 192.0.2.7: icmp_seq=4 ttl=57 time=21 ms\n"
                   "noch keine Antwort für icmp_seq=5\n"),
              (Delays{20, -1, -1, 21, -1}));
}

TEST(ReadPing, TakesTheSpacingOfTimeStamps)
{
    const std::string text = "[1700000000.000000] 64 bytes from h: icmp_seq=1 ttl=57 time=20 ms\n"
                             "[1700000000.750000] 64 bytes from h: icmp_seq=4 ttl=57 time=21 ms\n";
    EXPECT_EQ(told(text), (Delays{20, -1, -1, 21}));
    EXPECT_EQ(read_ping(text)->round_trip->spacing, 250ms);
}

TEST(ReadPing, ReadsWindowsInSeveralLanguagesWithTimeOutsAsLosses)
{
    const Delays expected{25, 0.5, -1, 24, -1};
    const auto block = [](const std::string& header, const std::string& a, const std::string& b,
                          const std::string& c, const std::string& timeout,
                          const std::string& unreachable) {
        return "\r\n" + header + "\r\n" + a + "\r\n" + b + "\r\n" + timeout + "\r\n" + c + "\r\n" +
               unreachable + "\r\n\r\n";
    };
    EXPECT_EQ(told(block("Pinging h [192.0.2.7] with 32 bytes of data:",
                         "Reply from 192.0.2.7: bytes=32 time=25ms TTL=53",
                         "Reply from 192.0.2.7: bytes=32 time<1ms TTL=53",
                         "Reply from 192.0.2.7: bytes=32 time=24ms TTL=53", "Request timed out.",
                         "Reply from 192.0.2.254: Destination host unreachable.") +
                   "Ping statistics for 192.0.2.7:\r\n"
                   "    Packets: Sent = 5, Received = 4, Lost = 1 (20% loss),\r\n"
                   "Approximate round trip times in milli-seconds:\r\n"
                   "    Minimum = 0ms, Maximum = 25ms, Average = 16ms\r\nControl-C\r\n"),
              expected);
    // The bytes are in the code pages 850 and 866, not in UTF-8.
    EXPECT_EQ(told(block("Ping wird ausgef\x81hrt f\x81r h [192.0.2.7] mit 32 Bytes Daten:",
                         "Antwort von 192.0.2.7: Bytes=32 Zeit=25ms TTL=53",
                         "Antwort von 192.0.2.7: Bytes=32 Zeit<1ms TTL=53",
                         "Antwort von 192.0.2.7: Bytes=32 Zeit=24ms TTL=53",
                         "Zeit\x81"
                         "berschreitung der Anforderung.",
                         "Antwort von 192.0.2.254: Zielhost nicht erreichbar.")),
              expected);
    EXPECT_EQ(told(block("Envoi d'une requ\x88te 'Ping'  192.0.2.7 avec 32 octets de donn\x82"
                         "es :",
                         "R\x82ponse de 192.0.2.7 : octets=32 temps=25 ms TTL=53",
                         "R\x82ponse de 192.0.2.7 : octets=32 temps<1ms TTL=53",
                         "R\x82ponse de 192.0.2.7 : octets=32 temps=24 ms TTL=53",
                         "D\x82lai d'attente de la demande d\x82pass\x82.",
                         "R\x82ponse de 192.0.2.254 : Impossible de joindre l'h\x93te.")),
              expected);
    EXPECT_EQ(told(block("Haciendo ping a h [192.0.2.7] con 32 bytes de datos:",
                         "Respuesta desde 192.0.2.7: bytes=32 tiempo=25ms TTL=53",
                         "Respuesta desde 192.0.2.7: bytes=32 tiempo<1m TTL=53",
                         "Respuesta desde 192.0.2.7: bytes=32 tiempo=24ms TTL=53",
                         "Tiempo de espera agotado para esta solicitud.",
                         "Respuesta desde 192.0.2.254: Host de destino inaccesible.")),
              expected);
    EXPECT_EQ(told(block("h [192.0.2.7]に ping を送信しています 32 バイトのデータ:",
                         "192.0.2.7 からの応答: バイト数 =32 時間 =25ms TTL=53",
                         "192.0.2.7 からの応答: バイト数 =32 時間 <1ms TTL=53",
                         "192.0.2.7 からの応答: バイト数 =32 時間 =24ms TTL=53",
                         "要求がタイムアウトしました。",
                         "192.0.2.254 からの応答: 宛先ホストに到達できません。")),
              expected);
    // With IPv6 there is no time to live.
    EXPECT_EQ(told(block("Pinging ::1 with 32 bytes of data:", "Reply from ::1: time=25ms ",
                         "Reply from ::1: time<1ms ", "Reply from ::1: time=24ms ",
                         "Request timed out.", "Destination host unreachable.")),
              expected);
}

TEST(ReadPing, ReadsSeveralBlocksOfWindowsWhoseStatisticsAreNoAnswers)
{
    const std::string block = "Pinging 192.0.2.7 with 32 bytes of data:\n"
                              "Request timed out.\n"
                              "Reply from 192.0.2.7: bytes=32 time=7ms TTL=53\n\n"
                              "Ping statistics for 192.0.2.7:\n"
                              "    Packets: Sent = 2, Received = 1, Lost = 1 (50% loss),\n"
                              "Approximate round trip times in milli-seconds:\n"
                              "    Minimum = 7ms, Maximum = 7ms, Average = 7ms\n\n";
    EXPECT_EQ(told(block + block), (Delays{-1, 7, -1, 7}));
    EXPECT_TRUE(read_ping(block)->remarks.empty());
    EXPECT_EQ(read_ping(block + "Pinging ::1 with 32 bytes of data:\nReply from ::1: time<1ms\n")
                  ->remarks,
              std::vector<std::string>{"1 of the answers took less than 1 ms: taken for 0.5 ms"});
}

TEST(ReadPing, ReadsWhatPowerShellHasWrittenInUtf16)
{
    std::string utf16 = "\xff\xfe";
    for (const char c : std::string{"Pinging ::1 with 32 bytes of data:\r\n"
                                    "Reply from ::1: time=2ms \r\n"}) {
        utf16 += c;
        utf16 += '\0';
    }
    EXPECT_EQ(told(base::plain_text(utf16).value()), Delays{2});
}

TEST(ReadPing, ReadsFpingLineByLineAndInOneLine)
{
    const std::string stamped =
        "[1700000000.5] 192.0.2.7 : [0], 84 bytes, 20.5 ms (20.5 avg, 0% loss)\n"
        "[1700000001.5] 192.0.2.7 : [1], timed out (20.5 avg, 50% loss)\n"
        "[1700000002.5] 192.0.2.7 : [2], 84 bytes, 22.25 ms (21.4 avg, 33% loss)\n"
        "[1700000002.5] 192.0.2.7 : duplicate for [2], 84 bytes, 23 ms\n\n"
        "192.0.2.7 : xmt/rcv/%loss = 3/2/33%, min/avg/max = 20.5/21.4/22.25\n";
    EXPECT_EQ(told(stamped), (Delays{20.5, -1, 22.25}));
    EXPECT_EQ(read_ping(stamped)->round_trip->spacing, 1s);
    EXPECT_EQ(told("192.0.2.7 : [0], timed out (NaN avg, 100% loss)\n"
                   "192.0.2.7 : [1], 84 bytes, 7.5 ms (7.5 avg, 50% loss)\n\n"
                   "192.0.2.7 : - 7.5\n"),
              (Delays{-1, 7.5}));
    EXPECT_EQ(told("192.0.2.7 : 15.5 - 14.25 -\n"), (Delays{15.5, -1, 14.25, -1}));
    EXPECT_EQ(read_ping("a : 15.5 -\nb : 14.25 -\n").error().message,
              "line 2: it has answers of two hosts, a and b: keep the lines of one, for example "
              "with grep");
}

TEST(ReadPing, NamesWhatItCannotRead)
{
    EXPECT_EQ(read_ping("PING x\nnothing\n").error().message,
              "line 2: nothing answered: no line has a time, such as time=20.5 ms");
    EXPECT_EQ(read_ping("PING x\nicmp_seq=70000 time=1 ms\n").error().message,
              "line 2: the number of an answer must be a whole number from 0 to 65535");
    EXPECT_EQ(read_ping("PING x\nicmp_seq=7 time=1000000001 ms\n").error().message,
              "line 2: a time must be from 0 to 10^9 ms");
    for (const char* other : {"t_s,delay_ms\n0,1\n", "20ms\n", "", "[wan]\ndelay = \"5ms\"\n"}) {
        EXPECT_FALSE(is_ping(other)) << other;
    }
}

} // namespace
} // namespace hapnet::emulator::tools
