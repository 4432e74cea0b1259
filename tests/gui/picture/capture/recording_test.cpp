#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include "gui/picture/capture/film.h"
#include "gui/picture/capture/recorder.h"
#include "gui/support/rig.h"

namespace winslow::gui::test {

namespace {

namespace fs = std::filesystem;

/// The programs of one folder alone are found, until this goes.
class OnlyPath {
 public:
  explicit OnlyPath(const fs::path& folder) {
    if (const char* path = std::getenv("PATH")) before_ = path;
    setenv("PATH", folder.c_str(), 1);
  }
  ~OnlyPath() { setenv("PATH", before_.c_str(), 1); }
  OnlyPath(const OnlyPath&) = delete;
  OnlyPath& operator=(const OnlyPath&) = delete;

 private:
  std::string before_;
};

/// A program "ffmpeg" of these lines of shell; the film's name is in $film.
void fake_ffmpeg(const fs::path& folder, const std::string& lines) {
  fs::create_directories(folder);
  const fs::path program = folder / "ffmpeg";
  std::ofstream(program) << "#!/bin/sh\nfor film; do :; done\n" << lines << "\n";
  fs::permissions(program, fs::perms::owner_all);
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

Image frame(std::uint8_t shade) { return {2, 2, std::vector<std::uint8_t>(16, shade)}; }

/// Until the recorder is done.
Recorder::Outcome finish(Recorder& recorder) {
  recorder.stop();
  for (;;) {
    if (auto outcome = recorder.poll()) return *outcome;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Three frames to a target; what it came to.
Recorder::Outcome record_three(Recorder& recorder, const fs::path& target,
                               const RecordingSpec& spec = {}) {
  recorder.start(target, spec);
  for (std::uint8_t k = 0; k < 3; ++k) recorder.add(frame(k));
  return finish(recorder);
}

}  // namespace

TEST_CASE("frames go into a folder, one file each") {
  TemporaryFolder folder;
  Recorder recorder;
  const auto outcome = record_three(recorder, folder / "film");
  CHECK(outcome.kind == Recorder::Outcome::Kind::done);
  CHECK(names_in(folder / "film") ==
        std::set<std::string>{"frame-00001.png", "frame-00002.png", "frame-00003.png"});
  CHECK(recorder.state() == Recorder::State::idle);
}

TEST_CASE("a film is made by ffmpeg, without a shell, and its frames go") {
  TemporaryFolder folder;
  fake_ffmpeg(folder / "bin", R"(echo frame=3
echo "$@" > "$film"
pwd >> "$film")");
  const OnlyPath path(folder / "bin");
  Recorder recorder;
  for (const std::string name : {"a film; $HOME.mp4", "b.gif"}) {
    const auto outcome = record_three(recorder, folder / name);
    INFO(outcome.text);
    REQUIRE(outcome.kind == Recorder::Outcome::Kind::done);
    const std::string made = bytes_of(folder / name);
    CHECK(made.find("-framerate 20") != std::string::npos);
    CHECK(made.find("frame-%05d.png") != std::string::npos);
    CHECK((made.find("palettegen") != std::string::npos) == name.ends_with(".gif"));
    CHECK(made.find(Recorder::frames_folder(folder / name).filename().string()) !=
          std::string::npos);
    CHECK_FALSE(fs::exists(Recorder::frames_folder(folder / name)));
  }
  RecordingSpec keep;
  keep.keep_frames = true;
  record_three(recorder, folder / "c.mp4", keep);
  CHECK(names_in(folder / "c-frames").size() == 3);
}

TEST_CASE("without ffmpeg the frames stay, and the user is told where") {
  TemporaryFolder folder;
  fs::create_directories(folder / "bin");
  const OnlyPath path(folder / "bin");
  Recorder recorder;
  const auto outcome = record_three(recorder, folder / "film.mp4");
  CHECK(outcome.kind == Recorder::Outcome::Kind::no_ffmpeg);
  CHECK(outcome.text.find((folder / "film-frames").string()) != std::string::npos);
  CHECK(names_in(folder / "film-frames").size() == 3);
  CHECK_FALSE(fs::exists(folder / "film.mp4"));
}

TEST_CASE("what ffmpeg complains about is shown, and the frames stay") {
  TemporaryFolder folder;
  fake_ffmpeg(folder / "bin", "echo half > \"$film\"; echo 'no such codec' >&2; exit 3");
  const OnlyPath path(folder / "bin");
  Recorder recorder;
  const auto outcome = record_three(recorder, folder / "film.mp4");
  CHECK(outcome.kind == Recorder::Outcome::Kind::failed);
  CHECK(outcome.text.find("no such codec") != std::string::npos);
  CHECK(outcome.text.find("status 3") != std::string::npos);
  CHECK(names_in(folder.path()) == std::set<std::string>{"bin", "film-frames"});
}

TEST_CASE("a film under way can be cancelled") {
  TemporaryFolder folder;
  fake_ffmpeg(folder / "bin", "echo half > \"$film\"; while :; do :; done");
  const OnlyPath path(folder / "bin");
  Recorder recorder;
  recorder.start(folder / "film.mp4", {});
  recorder.add(frame(1));
  recorder.stop();
  while (recorder.state() != Recorder::State::encoding) CHECK_FALSE(recorder.poll());
  recorder.cancel();
  CHECK(recorder.state() == Recorder::State::idle);
  CHECK(names_in(folder.path()) == std::set<std::string>{"bin"});
}

TEST_CASE("only frames of an earlier recording are replaced") {
  TemporaryFolder folder;
  const fs::path target = folder / "film";
  fs::create_directories(target);
  std::ofstream(target / "frame-00009.png") << "old";
  std::ofstream(target / "notes.txt") << "mine";
  CHECK(Recorder::occupied(target));
  CHECK_FALSE(Recorder::occupied(folder / "other"));
  Recorder recorder;
  record_three(recorder, target);
  CHECK(names_in(target) == std::set<std::string>{"frame-00001.png", "frame-00002.png",
                                                  "frame-00003.png", "notes.txt"});
}

TEST_CASE("a recording holds one frame for each shape of the mesh") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  rig.bench->apply(action::SetRecordingSpec{{.picture = {.size = {}, .panels = false}}});
  rig.bench->apply(action::StartRecording{rig.folder / "film", std::nullopt});
  rig.frames(3);
  const Recorder& recorder = rig.bench->capture().recorder();
  CHECK(recorder.frames() == 1);  // the mesh as it is
  CHECK(rig.visible("recording/stop"));
  rig.frames(5);
  CHECK(recorder.frames() == 1);
  rig.bench->apply(action::Scramble{3});
  REQUIRE(rig.settle());
  rig.frames(2);
  CHECK(recorder.frames() == 2);
  for (int k = 0; k < 4; ++k) {
    const int before = recorder.frames();
    const Coordinates shape = rig.session().coordinates();
    rig.key(keys::n);
    REQUIRE(rig.wait([&] {
      const auto& s = rig.session().job().snapshot();
      return s && s->state == JobState::paused && !(rig.session().coordinates() == shape);
    }));
    rig.frames(2);
    CHECK(recorder.frames() == before + 1);
  }
  rig.click("recording/stop");
  REQUIRE(rig.wait([&] { return recorder.state() == Recorder::State::idle; }));
  CHECK(names_in(rig.folder / "film").size() == 6);
}

TEST_CASE("by the clock frames come while the mesh rests, and the view may move") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  RecordingSpec spec;
  spec.when = RecordingSpec::When::timed;
  spec.rate = 60;
  spec.picture = {.size = std::array{160, 120}, .panels = false};
  rig.bench->apply(action::SetRecordingSpec{spec});
  rig.bench->apply(action::StartRecording{rig.folder / "film", std::nullopt});
  const Recorder& recorder = rig.bench->capture().recorder();
  REQUIRE(rig.wait([&] { return recorder.frames() >= 2; }));
  rig.bench->apply(action::LookAt{{0.5, 0, 0}, 0.1});
  const int before = recorder.frames();
  REQUIRE(rig.wait([&] { return recorder.frames() >= before + 2; }));
  rig.bench->apply(action::StopRecording{});
  REQUIRE(rig.settle());
  const auto names = names_in(rig.folder / "film");
  CHECK(bytes_of(rig.folder / "film" / *names.begin()) !=
        bytes_of(rig.folder / "film" / *names.rbegin()));
}

TEST_CASE("frames left out are counted and said") {
  TemporaryFolder folder;
  Recorder recorder;
  recorder.start(folder / "film", {});
  recorder.add(frame(1));
  recorder.drop();
  recorder.drop();
  CHECK(finish(recorder).text.find("2 more were left out") != std::string::npos);
}

TEST_CASE("a step of the history is recorded from its start to its end") {
  Rig rig(900, 600);
  rig.open(ring_mesh());
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::ApplyMotion{{30, Vec2(0, 0), Vec2(0, 0)}});
  REQUIRE(rig.settle());
  rig.bench->apply(action::Scramble{1});
  REQUIRE(rig.settle());
  rig.bench->apply(action::GoToStep{1});
  const Coordinates end = rig.mesh().coordinates;
  const std::size_t steps = rig.document().history().size();

  rig.bench->apply(action::StartRecording{rig.folder / "film", 1});
  REQUIRE(rig.settle());
  const auto frames = names_in(rig.folder / "film");
  const auto iterations = rig.document().history().result(1).outer_iterations;
  CHECK(frames.size() >= static_cast<std::size_t>(iterations));
  CHECK(rig.document().history().size() == steps);  // nothing that could be redone is lost
  CHECK(rig.document().history().position() == 1);
  CHECK(rig.mesh().coordinates == end);
  CHECK(bytes_of(rig.folder / "film" / *frames.begin()) !=
        bytes_of(rig.folder / "film" / *frames.rbegin()));
}

TEST_CASE("a recorded turn of 60 degrees has a frame for every degree, on record or again") {
  Rig rig(900, 600);
  rig.open(ring_mesh(48, 12));
  RecordingSpec spec;
  spec.picture = {.size = std::array{120, 90}, .panels = false, .legend = false};
  rig.bench->apply(action::SetRecordingSpec{spec});
  rig.bench->apply(action::SelectMarkers{{rig.marker("flap")}});
  rig.bench->apply(action::StartRecording{rig.folder / "live", std::nullopt});
  rig.bench->apply(action::ApplyMotion{{60, Vec2(0, 0), Vec2(0, 0)}});
  REQUIRE(rig.wait([&] { return !rig.session().in_motion(); }));
  const Coordinates end = rig.mesh().coordinates;
  rig.bench->apply(action::StopRecording{});
  REQUIRE(rig.settle());
  CHECK(names_in(rig.folder / "live").size() >= 60);
  CHECK(rig.session().coordinates() == end);

  rig.bench->apply(action::StartRecording{rig.folder / "again", 1});
  REQUIRE(rig.settle());
  CHECK(names_in(rig.folder / "again").size() >= 60);
  CHECK(rig.mesh().coordinates == end);
}

TEST_CASE("the dialog records to a file chosen next, and a discarded recording leaves nothing") {
  Rig rig(1280, 720);
  rig.open(ring_mesh());
  rig.click("tool/record");
  REQUIRE(rig.visible("record/accept"));
  rig.fill("record/rate", "10");
  rig.click("record/mesh_alone");
  rig.click("record/accept");
  REQUIRE(rig.visible("dialog/accept"));
  rig.fill("dialog/name", (rig.folder / "film.gif").string());
  rig.click("dialog/accept");
  rig.frames(3);
  CHECK(rig.bench->capture().recorder().state() == Recorder::State::recording);
  CHECK(rig.bench->capture().recorder().spec().rate == 10);
  CHECK(rig.visible("tool/stop_recording"));
  rig.click("recording/cancel");
  CHECK(rig.bench->capture().recorder().state() == Recorder::State::idle);
  CHECK(names_in(rig.folder.path()) == std::set<std::string>{"mesh.su2"});
}

TEST_CASE("nothing is recorded without a mesh, and an existing film is not replaced unasked") {
  Rig rig(900, 600);
  rig.bench->apply(action::StartRecording{rig.folder / "film.mp4", std::nullopt});
  CHECK(rig.bench->capture().recorder().state() == Recorder::State::idle);
  rig.open(ring_mesh());
  std::ofstream(rig.folder / "film.mp4") << "mine";
  rig.bench->apply(action::StartRecording{rig.folder / "film.mp4", std::nullopt});
  REQUIRE(rig.session().messages().prompt() != nullptr);
  CHECK(rig.session().messages().prompt()->kind == Prompt::Kind::question);
  CHECK(bytes_of(rig.folder / "film.mp4") == "mine");
}

}  // namespace winslow::gui::test
