// Jobs of several processes that are no job, and tasks of arrays that are no shard.
#include "program.h"

namespace raytube {
namespace {

using namespace raytube::testing;
using ::testing::HasSubstr;

class Launches : public BadInput {};

TEST_F(Launches, ProcessesThatCannotFindEachOtherAreRefused) {
  EXPECT_THAT(raytube("run case.toml", "SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=0 ").complaint, HasSubstr("srun --mpi=pmix"));
  const Outcome second = raytube("run case.toml", "SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=1 ");
  EXPECT_EQ(second.code, 2);
  EXPECT_EQ(second.complaint, "");
}

TEST_F(Launches, ProcessesOfAnotherMpiAreRefused) {
  const Outcome outcome = raytube("run case.toml", "PMI_SIZE=2 PMI_RANK=0 ");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, HasSubstr("was started as 2 processes"));
}

TEST_F(Launches, ALoneTaskOfAnArrayIsNotTheWhole) {
  ASSERT_EQ(raytube("run case.toml --shard 1/2 -o shards --quiet").code, 0);
  const std::string lone = "SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_MIN=2 SLURM_ARRAY_TASK_MAX=2 SLURM_ARRAY_TASK_COUNT=1 ";
  const Outcome outcome = raytube("run case.toml --shard slurm -o shards --quiet", lone);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.complaint, HasSubstr("--shard 1/1: "));
  EXPECT_THAT(outcome.complaint, HasSubstr("shard_1_of_2.looks belongs to another number of shards; write --shard I/N"));
}

}  // namespace
}  // namespace raytube
