// Finished cases come back from disk with every digit, and lines that are no results are left out.
#include "bench/store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/output_error.h"
#include "bench/bench_case.h"
#include "output/temporary_folder.h"
#include "results.h"

namespace drape::bench {
namespace {

using Store = ResultStore<CaseResult>;
using testing::Pointee;

std::string line_of(const CaseResult& result) { return json_line(json_of(result)); }

CaseResult first() { return test::swing_result(SolverMethod::relax, 20, 1.25, 1.0 / 3, 1e-300); }
CaseResult second() { return test::swing_result(SolverMethod::explicit_steps, 167, 7, 1e-6, 6e-5); }

TEST(StoreTest, GivesBackEveryDigit) {
    const TemporaryFolder folder;
    {
        Store store(folder / "results.jsonl");
        EXPECT_FALSE(store.find(first().key));
        store.add(first());
        store.add(second());
        EXPECT_THAT(store.find(first().key), Pointee(first()));
    }
    const Store again(folder / "results.jsonl");
    EXPECT_EQ(again.size(), 2u);
    EXPECT_THAT(again.find(first().key), Pointee(first()));
    EXPECT_THAT(again.find(second().key), Pointee(second()));
    EXPECT_FALSE(again.find("another version's key"));
}

TEST(StoreTest, StepsOverALineThatWasCutShort) {
    const TemporaryFolder folder;
    const std::string whole = line_of(first()) + "\n" + line_of(second());
    for (const std::size_t length : {whole.size() - 1, whole.size() - 200, line_of(first()).size() + 2}) {
        write_text(folder / "results.jsonl", whole.substr(0, length));
        Store store(folder / "results.jsonl");
        EXPECT_THAT(store.find(first().key), Pointee(first()));
        EXPECT_FALSE(store.find(second().key));
        store.add(second());
        const Store again(folder / "results.jsonl");
        EXPECT_THAT(again.find(first().key), Pointee(first()));
        EXPECT_THAT(again.find(second().key), Pointee(second()));
    }
}

TEST(StoreTest, LeavesOutWhatIsNoResult) {
    const TemporaryFolder folder;
    std::string other = line_of(first());
    other.replace(other.find("\"substeps\""), 10, "\"subspace\"");
    const std::string text = line_of(first());
    write_text(folder / "results.jsonl",
               "\nnull\n[1, 2]\n{}\n" + other + "\n" + text + " more\n{\"key\": 3}\n" + line_of(second()) + "\n");
    const Store store(folder / "results.jsonl");
    EXPECT_EQ(store.size(), 1u);
    EXPECT_TRUE(store.find(second().key));
}

TEST(StoreTest, SaysWhatItCannotWrite) {
    const TemporaryFolder folder;
    Store store(folder / "missing/results.jsonl");
    EXPECT_NE(error_text<OutputError>([&] { store.add(first()); }).find("missing/results.jsonl"), std::string::npos);
}

}  // namespace
}  // namespace drape::bench
