#include "table.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <map>

#include "program.h"

namespace raytube::testing {

namespace {

namespace fs = std::filesystem;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// Far above what any row needs, far below what a machine has; sanitizers take a multiple.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr long most_memory = 4L << 20;
#else
constexpr long most_memory = 1L << 20;  // [KiB]
#endif
constexpr rlim_t most_processor_time = 60;  // [s]; nothing here takes one
constexpr unsigned most_patience = 300;     // [s]; for what waits without end

struct Ending {
  int code = -1;    // -1: a signal
  long memory = 0;  // [KiB] at its highest
  std::string output, complaint;
};

void open_as(const fs::path& file, int stream) {
  const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(opened, stream);
}

[[noreturn]] void become(const std::string& before, const std::string& words, const fs::path& folder, const fs::path& logs) {
  open_as(logs / "stdout.txt", STDOUT_FILENO);
  open_as(logs / "stderr.txt", STDERR_FILENO);
  const rlimit processor_time{most_processor_time, most_processor_time};
  setrlimit(RLIMIT_CPU, &processor_time);
  alarm(most_patience);
  const std::string command = "cd '" + folder.string() + "' && " + before + "exec " RAYTUBE_PROGRAM " " + words;
  execl("/bin/bash", "bash", "-c", command.c_str(), nullptr);
  _exit(127);
}

Ending run(const std::string& before, const std::string& words, const fs::path& folder, const fs::path& logs) {
  const pid_t child = fork();
  if (child == 0) become(before, words, folder, logs);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, used.ru_maxrss, text_of(logs / "stdout.txt"),
          text_of(logs / "stderr.txt")};
}

// All there is below a folder: names, kinds, and what small files hold.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> all;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    const fs::file_status status = entry.symlink_status();
    std::string& what = all[entry.path().string()];
    what = std::to_string(static_cast<int>(status.type()));
    if (fs::is_symlink(status)) what += fs::read_symlink(entry).string();
    if (fs::is_regular_file(status)) what += entry.file_size() < 100'000'000 ? text_of(entry.path()) : "large";
  }
  return all;
}

TEST_P(BadTable, IsRefused) {
  const Scratch scratch, logs("logs");
  scratch.write("mesh.off", plate);
  scratch.write("case.toml", good_case);
  scratch.write("a.csv", "freq_hz,theta_deg,phi_deg,sigma_vv_dbsm\n1e9,90,0,10.5\n1e9,90,1,8\n");
  scratch.write("b.csv", "freq_hz,theta_deg,phi_deg,sigma_vv_dbsm\n1e9,90,0,10\n1e9,90,1,8\n");
  GetParam().prepare(scratch);
  const auto before = contents(scratch.folder());

  const Ending ending = run(GetParam().before, GetParam().words, scratch.folder(), logs.folder());
  EXPECT_EQ(ending.code, 2);
  EXPECT_EQ(ending.output, "");
  const std::string& sentence = ending.complaint;
  EXPECT_THAT(sentence, ::testing::StartsWith("raytube: "));
  EXPECT_THAT(sentence, HasSubstr(GetParam().place));
  EXPECT_THAT(sentence, HasSubstr(GetParam().says));
  EXPECT_THAT(sentence, AnyOf(HasSubstr("; "), HasSubstr("did you mean"), HasSubstr(" must "), HasSubstr("write "),
                              HasSubstr("needs ")));  // the remedy
  EXPECT_EQ(sentence.find('\n'), sentence.size() - 1) << sentence;
  EXPECT_TRUE(std::all_of(sentence.begin(), sentence.end() - 1, [](unsigned char c) { return c >= ' ' && c != 127; }))
      << sentence;
  EXPECT_LT(sentence.size(), 700u);
  EXPECT_LT(ending.memory, most_memory);
  EXPECT_EQ(contents(scratch.folder()), before);
}

}  // namespace

BadRow with_file(std::string name, const std::string& file, const std::string& bytes, std::string words, std::string says) {
  return {std::move(name), std::move(words), std::move(says), [=](const Scratch& scratch) { scratch.write(file, bytes); }, file};
}

}  // namespace raytube::testing
