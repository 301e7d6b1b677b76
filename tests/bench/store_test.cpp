// Finished cases come back from disk with every digit, and lines that are no results are left out.
#include "bench/store.h"

#include <gtest/gtest.h>

#include "output/output_error.h"
#include "output/temporary_folder.h"
#include "results.h"

namespace drape::bench {
namespace {

CaseResult first() { return test::swing_result(SolverMethod::relax, 20, 1.25, 1.0 / 3, 1e-300); }
CaseResult second() { return test::swing_result(SolverMethod::explicit_steps, 167, 7, 1e-6, 6e-5); }

TEST(StoreTest, GivesBackEveryDigit) {
    const TemporaryFolder folder;
    {
        ResultStore store(folder / "results.jsonl");
        EXPECT_FALSE(store.find(first().key));
        store.add(first());
        store.add(second());
        EXPECT_EQ(store.find(first().key), first());
    }
    const ResultStore again(folder / "results.jsonl");
    EXPECT_EQ(again.size(), 2u);
    EXPECT_EQ(again.find(first().key), first());
    EXPECT_EQ(again.find(second().key), second());
    EXPECT_FALSE(again.find("another version's key"));
}

TEST(StoreTest, StepsOverALineThatWasCutShort) {
    const TemporaryFolder folder;
    const std::string whole = result_line(first()) + "\n" + result_line(second());
    for (const std::size_t length : {whole.size() - 1, whole.size() - 200, result_line(first()).size() + 2}) {
        write_text(folder / "results.jsonl", whole.substr(0, length));
        ResultStore store(folder / "results.jsonl");
        EXPECT_EQ(store.find(first().key), first());
        EXPECT_FALSE(store.find(second().key));
        store.add(second());
        const ResultStore again(folder / "results.jsonl");
        EXPECT_EQ(again.find(first().key), first());
        EXPECT_EQ(again.find(second().key), second());
    }
}

TEST(StoreTest, LeavesOutWhatIsNoResult) {
    const TemporaryFolder folder;
    std::string other = result_line(first());
    other.replace(other.find("\"substeps\""), 10, "\"subspace\"");
    const std::string text = result_line(first());
    write_text(folder / "results.jsonl",
               "\nnull\n[1, 2]\n{}\n" + other + "\n" + text + " more\n{\"key\": 3}\n" + result_line(second()) + "\n");
    const ResultStore store(folder / "results.jsonl");
    EXPECT_EQ(store.size(), 1u);
    EXPECT_TRUE(store.find(second().key));
}

TEST(StoreTest, SaysWhatItCannotWrite) {
    const TemporaryFolder folder;
    ResultStore store(folder / "missing/results.jsonl");
    EXPECT_NE(error_text<OutputError>([&] { store.add(first()); }).find("missing/results.jsonl"), std::string::npos);
}

}  // namespace
}  // namespace drape::bench
