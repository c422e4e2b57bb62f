// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/report/report.hpp"
#include "tests/support/page_data.hpp"
#include "tests/support/tables.hpp"

#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::report {

// A small result folder "r", its tables as CSV.

inline results::File sample_manifest()
{
    return {"r/table1/manifest.json",
            R"({"command": "scripts/table1.sh --out r/table1", "version": "0.4.0",
                "compiler": "GCC 12.2.0", "wall_time_s": 61.53, "title": "160 ms & more",
                "configuration": "seeds = 2\n", "seeds": [1, 2], "valid": true,
                "invalid_because": [], "sessions": {"played": 42, "reused": 0},
                "simulated_s": 1260.0, "speed_ratio": 612.25})"};
}

inline results::File sample_table1()
{
    return {"r/table1/table1.csv",
            "algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,paper_std_mm,"
            "verdict,class,max_class,max_low_mm,max_high_mm\n"
            "base,13.611,0.000,47.251,10.683,13.789,46.010,10.986,calibrated,calibrated,"
            "calibrated,41.4,50.6\n"
            "sep,13.620,0.000,47.200,10.690,13.991,50.120,10.808,met,by-construction,"
            "by-construction,45.8,48.7\n"
            "dead-reckoning,3.402,0.000,66.610,4.190,3.341,58.850,3.840,missed,selected,"
            "predicted,40,65\n"};
}

inline results::File sample_tasks()
{
    return {"r/table1/tasks.csv",
            "algorithm,task,seeds,mean_mm,std_mm,max_mm,vibration_mm,stiffness_ratio,"
            "force_vibration_n,force_discrepancy,contact_lost,force_step_n,drag_n,energy_mj,tier,"
            "limited_by\n"
            "base,T2,10,1.250,0.500,3.000,0.012,0.1130,0.0150,0.2500,,0.4000,,0.100,usable,"
            "\"stiffness 0.11, not 0.77\"\n"};
}

inline results::File sample_limits()
{
    return {"r/fig6a/limits.csv",
            "algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,"
            "ci_high,seeds\n"
            "base,delay,T1,320,>,ms,,,predicted,320,,320,,40\n"
            "base,delay,worst,160,=,ms,160,calibrated,calibrated,160,150,157,163,40\n"
            "dead-reckoning,delay,worst,145,=,ms,150,predicted-met,predicted,145,140,143,147,40\n"
            "dead-reckoning,jitter,worst,2.5,=,ms,5,selected-missed,selected,2.5,2,2.4,2.6,40\n"};
}

inline results::File sample_loss_limits()
{
    return {"r/fig6b/limits.csv",
            "algorithm,impairment,task,limit,bound,unit,paper_limit,status,class,p50,p10,ci_low,"
            "ci_high,seeds\n"
            "base,burst-loss,worst,95,>,of_100,40,selected-missed,selected,95,,95,,40\n"};
}

inline results::File sample_curves()
{
    return {"r/fig6a/curves.csv",
            "algorithm,impairment,task,level,unit,seed,counts,mean_mm,vibration_mm,"
            "stiffness_ratio,force_vibration_n,tier\n"
            "base,delay,T1,40,ms,1,true,3.4,0.10,,0.0100,usable\n"
            "base,delay,T1,80,ms,1,true,6.8,1.20,,0.0200,unusable\n"};
}

inline results::File sample_conventions()
{
    return {"r/fig6a/limits_by_convention.csv",
            "algorithm,impairment,task,filter_order,hand,limit,bound,unit,ci_low,ci_high,seeds\n"
            "base,delay,T1,1,nominal,145,=,ms,140,150,10\n"
            "base,delay,T1,4,nominal,182,>,ms,182,,10\n"};
}

inline results::File sample_trajectories()
{
    return {"r/fig7/trajectories.csv",
            "algorithm,time_s,cube_l_mm,cube_r_mm,hand_l_mm,hand_r_mm,force_l_n,force_r_n\n"
            "sep,0.000,0.0,0.0,-25,25,0.1,-0.1\n"
            "sep,0.005,1.0,-3.0,-24,25,0.1,-0.1\n"};
}

inline results::File sample_qos()
{
    return {"r/qos/qos.csv", "algorithm,task,delay_ms,jitter_ms,loss_percent,mean_mm,vibration_mm,"
                             "stiffness_ratio,force_vibration_n,tier\n"
                             "base,T1,0,0,0,0.1,0.010,,0.0100,good\n"
                             "base,T2,0,0,0,0.1,0.010,0.90,0.0100,usable\n"
                             "base,T1,160,5,0,13,0.500,,0.0400,unusable\n"};
}

inline results::File sample_real_time()
{
    return {"r/table1/real_time.csv",
            "algorithm,where,mean_mm,std_mm,max_mm,virtual_mean_mm,virtual_std_mm,virtual_max_mm,"
            "difference_percent,valid,invalid_because\n"
            "base,loopback,13.00,10.60,44.6,13.61,10.68,47.25,-4.5,true,\n"
            "base,namespaces,9.99,10.60,44.6,13.61,10.68,47.25,-26.6,false,late ticks\n"};
}

inline results::File sample_replay()
{
    return {"r/table1/replay/dead-reckoning-T3.csv",
            "time_s,lx,ly,lz,lhx,lhy,lhz,lfx,rx,ry,rz,rhx,rhy,rhz,rfx\n"
            "0.00,0,0,0,-25,0,0,-0.5,0,0,0,25,0,0,0.5\n"
            "0.01,1,0,0,-24,0,0,-0.5,-3,0,0,25,0,0,0.5\n"};
}

inline results::File sample_claims()
{
    return {"r/beat/claims.csv", "claim,value,accept,verdict\n"
                                 "\"mean discrepancy: P1, T1\",\"5.97, 5.42\",\"<= 6, <= 7\",met\n"
                                 "stiffness at 100 ms,0.98 to 1.46,0.75 to 1.25,missed\n"};
}

inline results::File sample_claims_quantiles()
{
    return {"r/beat/claims_quantiles.csv", "claim,quantile,seeds\n"
                                           "stiffness at 100 ms,0.98 to 1.32,40\n"
                                           "\"mean discrepancy: P1, T1\",\"5.96, 5.41\",40\n"};
}

inline results::File sample_precision()
{
    return {"r/precision/precision.csv",
            "algorithm,task,figure,parameter,value,reference,seeds,ticks,found,difference,ci_low,"
            "ci_high,error\n"
            "base,P1,mean_mm,tick,4ms,0.5ms,1,60000,13.900000,0.700000,,,0.700000\n"
            "base,P1,mean_mm,tick,2ms,0.5ms,1,120000,13.500000,0.300000,,,0.300000\n"
            "base,P1,mean_mm,tick,0.5ms,0.5ms,1,480000,13.200000,0.000000,,,0.000000\n"
            "base,T1,vibration_mm,tick,2ms,0.5ms,1,120000,0.5,0.1,0.08,0.12,0.220000\n"
            "base,T1,vibration_mm,tick,2ms,0.5ms,10,1200000,0.5,0.1,0.08,0.12,0.110000\n"
            "base,T1,vibration_mm,tick,0.5ms,0.5ms,1,480000,0.4,0,0,0,0.200000\n"
            "base,T1,vibration_mm,tick,0.5ms,0.5ms,10,4800000,0.4,0,0,0,0.063000\n"};
}

inline results::File sample_claim_sessions()
{
    return {
        "r/beat/sessions.csv",
        "algorithm,condition,task,hands,peers,delay_ms,jitter_ms,loss_percent,burst_of_100,seed,"
        "mean_mm,max_mm,vibration_mm,stiffness_ratio,force_vibration_n,force_above_2hz_n,"
        "force_discrepancy,contact_lost,energy_mj,scored_share,tier\n"
        "remote-proxy,100ms,T1,nominal,2,100,0,0,0,9001,3,9,0.1,,0.01,0.0500,,,1,1,good\n"
        "remote-proxy,100ms,T1,nominal,2,100,0,0,0,9002,3,9,0.1,,0.01,0.0900,,,1,1,good\n"
        "remote-proxy,100ms,T1,nominal,2,100,0,0,0,9003,3,9,0.1,,0.01,0.0700,,,1,1,good\n"
        "base,100ms,T1,nominal,2,100,0,0,0,9001,3,9,0.1,,0.01,0.9000,,,1,1,good\n"};
}

inline std::vector<results::File> whole_sample()
{
    return {sample_manifest(),         sample_table1(),       sample_tasks(),
            sample_limits(),           sample_loss_limits(),  sample_curves(),
            sample_conventions(),      sample_trajectories(), sample_qos(),
            sample_real_time(),        sample_replay(),       sample_claims(),
            sample_claims_quantiles(), sample_precision()};
}

/// The files with each table in JSON, as experiments write it.
inline std::vector<results::File> as_written(const std::vector<results::File>& files)
{
    std::vector<results::File> written;
    for (const results::File& file : files) {
        if (!file.path.ends_with(".csv")) {
            written.push_back(file);
            continue;
        }
        const auto replay = file.path.rfind("/replay/");
        const auto slash = std::min(replay, file.path.rfind('/'));
        const auto name = file.path.substr(slash + 1, file.path.size() - slash - 5);
        written.push_back({file.path.substr(0, slash) + "/results.json",
                           results::json_text(std::vector{test::table_from_csv(name, file.text)})});
    }
    return written;
}

/// Returns the files of the report on these files, which must be readable.
inline std::vector<results::File> report_files(const std::vector<results::File>& files)
{
    const auto results = read_results(as_written(files));
    EXPECT_TRUE(results) << results.error().message;
    return results ? report_of(*results) : std::vector<results::File>{};
}

inline std::string text_of(const std::vector<results::File>& files, std::string_view path)
{
    for (const results::File& file : files) {
        if (file.path == path) return file.text;
    }
    return "";
}

inline std::string page_of(const std::vector<results::File>& files)
{
    return text_of(report_files(files), "report.html");
}

/// Returns the words and tables of the page for these files, as JSON.
inline std::string words_of(const std::vector<results::File>& files)
{
    return test::words_of(page_of(files));
}

/// Returns a figure of that page; null when it has none with that id.
inline nlohmann::ordered_json figure_of(const std::vector<results::File>& files,
                                        std::string_view id)
{
    return test::figure_of(page_of(files), id);
}

inline bool holds(std::string_view text, std::string_view part)
{
    return text.find(part) != std::string_view::npos;
}

} // namespace hapnet::lab::report
