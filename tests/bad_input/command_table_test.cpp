// The rows of the bad-input table that are about tables of other programs, folders and the command line.
#include "program.h"
#include "table.h"

namespace raytube::testing {
namespace {

namespace fs = std::filesystem;

BadRow looks(const std::string& name, const std::string& bytes, const std::string& says) {
  const std::string remove = " --set 'look={looks_csv=\"bad.csv\"}'";
  return with_file(name, "bad.csv", bytes, "run case.toml" + remove, says);
}

BadRow pattern(const std::string& name, const std::string& bytes, const std::string& says) {
  return with_file(name, "bad.csv", bytes, "run case.toml --set radar.range_m=3 --set radar.pattern_csv=bad.csv", says);
}

BadRow result(const std::string& name, const std::string& bytes, const std::string& says) {
  return with_file(name, "bad.csv", bytes, "compare a.csv bad.csv -o out", says);
}

std::string in_utf16(const std::string& text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) bytes += {c, '\0'};
  return bytes;
}

BadRow pixels(const std::string& name, const std::string& bytes, const std::string& says) {
  BadRow row = with_file(name, "bad.csv", bytes, "compare bad.csv image.csv -o out", says);
  const auto with_bad = row.prepare;
  row.prepare = [with_bad](const Scratch& scratch) {
    with_bad(scratch);
    scratch.write("image.csv", "col,row,magnitude_vv\n0,0,1\n1,0,2\n0,1,1\n1,1,0\n");
  };
  return row;
}

std::vector<BadRow> image_rows() {
  const std::string header = "col,row,magnitude_vv\n", whole = header + "0,0,1\n1,0,2\n0,1,1\n1,1,0\n";
  return {
      pixels("image_against_table", "phi_deg,sigma_vv_dbsm\n0,1\n",
             "image.csv is an image and bad.csv is not; compare two images, or two tables of looks"),
      pixels("image_without_rows", header, ": no rows below the header; nothing can be compared"),
      pixels("image_without_channels", "col,row,brightness\n0,0,1\n", ", line 1: no channel; name at least re_vv and im_vv"),
      pixels("image_of_another_channel", "col,row,magnitude_hh\n0,0,1\n1,0,2\n0,1,1\n1,1,0\n",
             "have no channel in common; name one"),
      pixels("image_with_a_gap", header + "0,0,1\n1,0,2\n0,1,1\n",
             ": has 3 rows for 2 x 2 pixels; give each pixel of a rectangle once"),
      pixels("image_with_a_pixel_twice", header + "0,0,1\n1,0,2\n0,1,1\n0,0,1\n",
             ": the pixel at 0, 0 stands there twice; remove one"),
      pixels("image_of_uneven_pixels", header + "0,0,1\n1,0,2\n3,0,2\n", ": col are not in even steps"),
      pixels("image_of_another_size", header + "0,0,1\n1,0,2\n", "has 2 x 1 pixels, "),
      pixels("image_of_nan", header + "0,0,nan\n", ", line 2, column magnitude_vv: \"nan\" is not a finite number"),
      pixels("image_in_space", "range_m,cross_range_m,height_m,magnitude_vv\n0,0,0,1\n", "is an image in space"),
      {"image_zero_throughout", "compare image.csv dark.csv",
       "dark.csv: zero in every pixel compared; give a reference with a signal",
       [=](const Scratch& scratch) {
         scratch.write("image.csv", whole);
         scratch.write("dark.csv", header + "0,0,0\n1,0,0\n0,1,0\n1,1,0\n");
       }},
      {"image_elsewhere", "compare here.csv there.csv", "here.csv and there.csv do not overlap: u from 0 m",
       [](const Scratch& scratch) {
         scratch.write("here.csv", "u_m,v_m,magnitude_vv\n0,0,1\n1,0,2\n");
         scratch.write("there.csv", "u_m,v_m,magnitude_vv\n5,0,1\n6,0,2\n");
       }},
      {"tables_not_registered", "compare a.csv b.csv --no-register",
       "--no-register: only images are registered; leave the option out"},
      {"image_only", "compare image.csv image.csv --only phi_deg=0",
       "--only phi_deg=0: images have no rows of looks; leave the option out",
       [=](const Scratch& scratch) { scratch.write("image.csv", whole); }},
  };
}

std::vector<BadRow> looks_rows() {
  const std::string header = "theta_deg,phi_deg\n";
  return {
      looks("looks_of_no_bytes", "", ": no looks; write the header"),
      looks("looks_without_rows", header, ": no looks; write the header"),
      looks("looks_only_comments", "# theta_deg,phi_deg\n# 1,2\n", ": no looks"),
      looks("looks_without_phi", "theta_deg\n1\n", ", line 1: the header must be"),
      looks("looks_the_other_way_round", "phi_deg,theta_deg\n1,2\n", ", line 1: the header must be"),
      looks("looks_with_half_a_receiver", "theta_deg,phi_deg,rx_theta_deg\n1,2,3\n", ", line 1: the header must be"),
      looks("looks_text_cell", header + "1,2\nnorth,2\n", ", line 3, column theta_deg: \"north\" is not a finite number; write"),
      looks("looks_empty_cell", header + "1,\n", ", line 2, column phi_deg: \"\" is not a finite number"),
      looks("looks_infinite", header + "1,inf\n", ", line 2, column phi_deg: \"inf\" is not a finite number"),
      looks("looks_hexadecimal", header + "0x10,1\n", ", line 2, column theta_deg: \"0x10\" is not a finite number"),
      looks("looks_too_few_cells", header + "1,2\n3\n", ", line 3: 1 values where the header names 2 columns; correct the line"),
      looks("looks_too_many_cells", header + "1,2,3\n", ", line 2: 3 values where the header names 2 columns"),
      looks("looks_quoted_comma", header + "\"1,2\",3\n", ", line 2: 3 values where the header names 2 columns"),
      looks("looks_below_zero", header + "-0.001,0\n", ", line 2: theta must be from 0 to 180 degrees"),
      looks("looks_of_1e308", header + "1,1e308\n", ", line 2: phi_deg is 1e+308, too large for an angle"),
      looks("looks_received_at_1e20", "theta_deg,phi_deg,rx_theta_deg,rx_phi_deg\n1,2,3,1e20\n",
            ", line 2: rx_phi_deg is 1e+20, too large"),
      looks("looks_in_utf16", in_utf16(header + "1,2\n"), ": is text in UTF-16; save it as UTF-8"),
      looks("looks_with_nul", header + std::string("1\0,2\n", 5), ", line 2, column theta_deg: \"1?\" is not a finite number"),
      looks("looks_line_of_2e6_bytes", header + std::string(2000000, '1') + ",2\n",
            ", line 2 is longer than 1000000 bytes; give a table"),
      looks("looks_cell_of_1e5_digits", header + std::string(100000, '9') + ",2\n", ", line 2, column theta_deg: \"999"),
      looks("looks_of_zeros", std::string(2000000, '\0'), ", line 1 is longer than 1000000 bytes; give a table"),
      {"looks_missing", "run case.toml --set 'look={looks_csv=\"none.csv\"}'",
       "none.csv: cannot be read; look.looks_csv must name"},
      {"looks_folder", "run case.toml --set 'look={looks_csv=\".\"}'", "cannot be read; look.looks_csv must name"},
      {"looks_endless_device", "run case.toml --set 'look={looks_csv=\"/dev/zero\"}'",
       "/dev/zero: cannot be read; look.looks_csv must name"},
      {"looks_name_empty", "run case.toml --set 'look={looks_csv=\"\"}'",
       "look.looks_csv is empty; give the file of the look list, relative to the case file"},
      {"looks_beside_angles", "run case.toml --set look.looks_csv=a.csv",
       "look.looks_csv cannot be combined with look.theta_deg; remove"},
      pattern("pattern_of_1e300_degrees", "angle_deg,azimuth_db,elevation_db\n0,0,0\n1e300,-3,-3\n",
              ", line 3: angle_deg must lie in -360 to 360 degrees (found 1e+300)"),
      pattern("pattern_of_one_row", "angle_deg,azimuth_db,elevation_db\n0,0,0\n",
              ": an antenna pattern needs at least two rows; "),
      pattern("pattern_descending", "angle_deg,azimuth_db,elevation_db\n1,0,0\n0,0,0\n",
              ", line 3: angle_deg must ascend; sort the rows"),
      pattern("pattern_ragged", "angle_deg,azimuth_db,elevation_db\n0,0\n",
              ", line 2: 2 values where the header names 3 columns"),
  };
}

std::vector<BadRow> result_rows() {
  return {
      result("result_of_no_bytes", "", ": holds no table; give a file"),
      result("result_without_rows", "phi_deg,sigma_vv_dbsm\n", ": no rows below the header; "),
      result("result_without_keys", "a,sigma_vv_dbsm\n1,2\n", ", line 1: no column to match rows by; name at least one"),
      result("result_without_channels", "phi_deg,a\n1,2\n", ", line 1: no channel; name at least"),
      result("result_with_a_channel_of_another_name", "phi_deg,RCS [dBsm]\n1,2\n",
             "or say which of phi_deg, rcs [dbsm] it is, as in --reference-columns sigma_vv_dbsm=NAME"),
      result("result_with_keys_of_another_name", "Azimuth,sigma_vv_dbsm\n1,2\n",
             "or say which of azimuth, sigma_vv_dbsm it is, as in --reference-columns phi_deg=NAME"),
      result("result_of_1e300_decibels", "phi_deg,sigma_vv_dbsm\n0,1e300\n",
             ", line 2: 1e+300 dBsm is no radar cross-section; write 10 log10 of square metres, or give those as sigma_vv_m2"),
      result("result_of_negative_square_metres", "phi_deg,sigma_vv_m2\n0,-3\n",
             ", line 2: sigma in square metres must be 0 or more; if it is in dBsm"),
      {"result_of_square_metres", "compare bad.csv levels.csv -o out",
       "bad.csv: sigma_vv_dbsm holds square metres, it seems: read as dBsm it lies 20.2 dB from levels.csv, read as m^2",
       [](const Scratch& scratch) {
         scratch.write("bad.csv", "phi_deg,sigma_vv_dbsm\n0,0.01\n1,0.02\n2,0.005\n");
         scratch.write("levels.csv", "phi_deg,sigma_vv_dbsm\n0,-20\n1,-17\n2,-23\n");
       }},
      result("result_column_twice", "phi_deg,phi_deg,sigma_vv_dbsm\n1,2,3\n",
             ", line 1: two columns are named phi_deg; rename or remove one"),
      result("result_half_an_amplitude", "phi_deg,re_vv\n1,2\n", ", line 1: re_vv and im_vv go together; add the missing one"),
      result("result_text_cell", "phi_deg,sigma_vv_dbsm\n1,loud\n",
             ", line 2, column sigma_vv_dbsm: \"loud\" is not a finite number; write"),
      result("result_nan", "phi_deg,sigma_vv_dbsm\n1,nan\n", ", line 2, column sigma_vv_dbsm: \"nan\" is not a finite number"),
      result("result_ragged", "phi_deg,sigma_vv_dbsm\n1,2\n1,2,3\n", ", line 3: 3 values where the header names 2 columns"),
      result("result_negative_magnitude", "phi_deg,magnitude_vv\n1,-2\n", ", line 2: a magnitude must be 0 or more"),
      result("result_frequency_zero", "freq_hz,sigma_vv_dbsm\n0,2\n", ", line 2: the frequency must be greater than 0"),
      result("result_third_polarisation", "phi_deg,tx_pol,v_magnitude\n1,x,2\n",
             ", line 2: the transmit polarisation is \"x\"; write v or h"),
      result("result_unpaired_polarisations", "phi_deg,tx_pol,v_magnitude\n1,v,2\n2,v,2\n1,h,2\n",
             "do not come in pairs; add the missing ones"),
      result("result_in_utf16", in_utf16("phi_deg,sigma_vv_dbsm\n1,2\n"), ": is text in UTF-16"),
      result("result_is_a_picture", "\x89PNG\r\n\x1a\n" + std::string(100, '\0'), "no column to match rows by; name"),
      result("result_with_1e5_columns", std::string(200000, ',') + "\n", ", line 1: "),
      result("result_with_nothing_in_common", "phi_deg,sigma_vv_dbsm\n50,1\n", "have no row in common"),
      result("result_zero_throughout", "phi_deg,sigma_vv_dbsm\n0,-inf\n1,-inf\n", "; "),
      {"run_into_a_table", "run case.toml -o fresh.csv", "-o fresh.csv: results are a folder of files"},
      {"compare_radar_explorer", "compare a.csv HH_scene.json",
       "HH_scene.json: is no table; what the Radar Explorer Toolkit opens"},
      {"compare_endless_device", "compare a.csv /dev/zero", "/dev/zero: cannot be read; give the path of a readable table"},
      {"compare_map_without_equals", "compare a.csv b.csv --result-columns phi_deg",
       "--result-columns phi_deg: write OURS=THEIRS"},
      {"compare_map_of_a_header_in_square_metres", "compare a.csv bad.csv --reference-columns 'sigma_vv_dbsm=\"RCS [m^2]\"'",
       "rcs [m^2] is in m^2, not in dBsm; write --reference-columns 'sigma_vv_m2=\"rcs [m^2]\"'",
       [](const Scratch& scratch) { scratch.write("bad.csv", "phi_deg,RCS [m^2]\n0,1\n1,2\n"); }},
      {"compare_map_with_an_open_quote", "compare a.csv b.csv --result-columns 'phi_deg=\"az'",
       "phi_deg=\"az: write OURS=THEIRS"},
      {"compare_map_unknown", "compare a.csv b.csv --result-columns phi_deg=az",
       "a.csv, line 1: no column is named az; choose among"},
      {"compare_map_times_zero", "compare a.csv b.csv --result-columns phi_deg=phi_deg*0",
       "--result-columns phi_deg=phi_deg*0: "},
      {"compare_map_times_text", "compare a.csv b.csv --result-columns 'phi_deg=phi_deg*pi'",
       "--result-columns phi_deg=phi_deg*pi: "},
      {"compare_only_nan", "compare a.csv b.csv --only phi_deg=nan:1", "--only phi_deg=nan:1: write"},
      {"compare_tolerance_infinite", "compare a.csv b.csv --tolerance-db inf",
       "--tolerance-db: needs a number of decibels, 0 or more (found inf)"},
      {"compare_into_a_file", "compare a.csv b.csv -o case.toml", "output folder case.toml: cannot be created"},
  };
}

std::vector<BadRow> folder_rows() {
  const std::string set = " --set output.plots=false";
  return {
      {"output_is_a_file", "run case.toml -o mesh.off", "output folder mesh.off: cannot be created"},
      {"output_below_a_file", "run case.toml -o mesh.off/out", "output folder mesh.off/out: cannot be created"},
      {"output_in_proc", "run case.toml -o /proc/out", "output folder /proc/out: cannot be created"},
      {"output_is_a_device", "run case.toml -o /dev/null", "output folder /dev/null: cannot be created"},
      {"output_link_to_itself", "run case.toml -o loop", "output folder loop: cannot be created",
       [](const Scratch& scratch) { fs::create_symlink("loop", scratch / "loop"); }},
      {"output_below_a_link_to_itself", "run case.toml -o loop/out", "output folder loop/out: cannot be created",
       [](const Scratch& scratch) { fs::create_symlink("loop", scratch / "loop"); }},
      {"output_link_to_nothing", "run case.toml -o link", "output folder link: cannot be created",
       [](const Scratch& scratch) { fs::create_symlink("/proc/none/out", scratch / "link"); }},
      {"output_name_of_5000_letters", "run case.toml -o " + std::string(5000, 'o'),
       "cannot be created (File name too long); choose another one"},
      {"output_name_empty", "run case.toml -o ''", "needs the name of a folder; see raytube run --help"},
      {"output_from_a_vanished_folder", "run $OLDPWD/case.toml -o out", "output folder out: cannot be found from here",
       [](const Scratch&) {}, "", "mkdir gone && cd gone && rmdir ../gone && "},
      {"wedges_over_the_mesh", "check case.toml --wedges mesh.off", "--wedges mesh.off: a list of wedges"},
      {"wedges_into_a_folder", "check case.toml --wedges .", "--wedges .: a list of wedges"},
      {"wedges_into_a_missing_folder", "check case.toml --wedges none/wedges.csv",
       "--wedges none/wedges.csv: cannot be written; "},
      {"wedge_lines_over_the_mesh", "check case.toml --wedges mesh.vtp", "--wedges mesh.vtp: is not an earlier result; ",
       [](const Scratch& scratch) { scratch.write("mesh.vtp", plate); }},
      {"paths_over_somebody_elses", "trace case.toml --look 0 --all --paths mesh.vtp",
       "--paths mesh.vtp: is not an earlier result; ", [](const Scratch& scratch) { scratch.write("mesh.vtp", plate); }},
      {"hits_over_somebody_elses", "trace case.toml --look 0 --all --hits mesh.vtu",
       "--hits mesh.vtu: is not an earlier result; ", [](const Scratch& scratch) { scratch.write("mesh.vtu", plate); }},
      {"paths_into_a_missing_folder", "trace case.toml --look 0 --all --paths none/paths.vtp",
       "--paths none/paths.vtp: cannot be written; "},
      {"hits_into_a_missing_folder", "trace case.toml --look 0 --all --hits none/hits.vtu",
       "--hits none/hits.vtu: cannot be written; "},
      {"surface_rays_over_the_mesh", "trace case.toml --look 0 --surface-rays mesh.off",
       "--surface-rays mesh.off: is not an earlier result; "},
      {"surface_rays_into_a_folder", "trace case.toml --look 0 --surface-rays .", "--surface-rays .: cannot be written; "},
      {"surface_rays_into_a_missing_folder", "trace case.toml --look 0 --surface-rays none/rays.vtp",
       "--surface-rays none/rays.vtp: cannot be written; "},
  };
}

BadRow taken(const std::string& name, const std::string& file, const std::string& words) {
  return with_file("taken_" + name, file, "somebody's own", words + " -o .",
                   ": is in the place of a result, and is not as raytube");
}

// A file that is read, in the place of a result.
BadRow read(const std::string& name, const std::string& file, const std::string& bytes, const std::string& words,
            const std::string& key) {
  return with_file("read_" + name, file, bytes, words + " -o .", ": is an input (" + key + "), and a result of that name");
}

std::vector<BadRow> place_rows() {
  const std::string sources =
      "[scene]\n[[scene.parts]]\nname = \"a\"\nmesh = \"hits.ply\"\nunit = \"m\"\nsurface = "
      "\"pec\"\n[source]\npoint_m = [0, 0, 1]\nrays = 10\ncounted = \"a\"\n";
  const std::string table = "phi_deg,sigma_vv_dbsm\n0,1\n";
  const auto folder = [](const char* name) { return [name](const Scratch& scratch) { fs::create_directory(scratch / name); }; };
  return {
      taken("rcs_csv", "rcs.csv", "run case.toml"),
      taken("channels_csv", "channels.csv", "run case.toml"),
      taken("run_json", "run.json", "run case.toml"),
      taken("parts_csv", "parts.csv", "run case.toml --parts"),
      taken("rcs_svg", "rcs.svg", "run case.toml"),
      taken("image_csv", "image.csv", "run case.toml --set output.image_look=0"),
      taken("image_png", "image_phase.png", "run case.toml --set output.image_look=0"),
      taken("resumed", "rcs.csv", "run case.toml --resume"),
      taken("converge_csv", "converge.csv", "converge case.toml"),
      taken("compare_csv", "compare.csv", "compare a.csv b.csv"),
      taken("compare_png", "compare.png", "compare a.csv b.csv"),
      read("case", "run.json", good_case, "run run.json", "the case"),
      read("looks", "rcs.csv", "theta_deg,phi_deg\n1,2\n", "run case.toml --set 'look={looks_csv=\"rcs.csv\"}'",
           "look.looks_csv"),
      read("pattern", "channels.csv", "angle_deg,azimuth_db,elevation_db\n0,0,0\n90,-3,-3\n",
           "run case.toml --set radar.range_m=3 --set radar.pattern_csv=channels.csv", "radar.pattern_csv"),
      read("medium", "channels.csv", "freq_ghz,eps_real,eps_loss\n1,4,0\n20,4,0\n",
           "run case.toml --set target.material=a --set materials.a.kind=dielectric --set materials.a.table_csv=channels.csv",
           "table_csv"),
      read("second_mesh", "rcs.csv", plate, "run case.toml --set 'target.mesh=[\"mesh.off\", \"rcs.csv\"]'", "target.mesh"),
      read("table", "compare.csv", table, "compare compare.csv compare.csv", "the first table"),
      {"read_mesh", "sources scene.toml -o .", "hits.ply: is an input (scene.parts.mesh), and a result of that name",
       [=](const Scratch& scratch) {
         scratch.write("scene.toml", sources);
         scratch.write("hits.ply", "ply\n");
       }},
      {"read_through_a_link", "run linked.json -o .", "run.json: is an input (the case)",
       [](const Scratch& scratch) {
         scratch.write("run.json", good_case);
         fs::create_symlink("run.json", scratch / "linked.json");
       }},
      {"folder_for_a_table", "run case.toml -o .", "rcs.csv: is a folder in the place of a result; move it away",
       folder("rcs.csv")},
      {"folder_for_a_picture", "run case.toml -o .", "rcs.png: is a folder in the place of a result; move it away",
       folder("rcs.png")},
      {"link_for_a_table", "run case.toml -o .", "rcs.csv: is in the place of a result",
       [](const Scratch& scratch) { fs::create_symlink("nowhere", scratch / "rcs.csv"); }},
  };
}

std::vector<BadRow> command_rows() {
  return {
      {"command_misspelt", "rnu case.toml", "did you mean \"run\"?"},
      {"option_misspelt", "run case.toml --quite", "did you mean --quiet?"},
      {"result_of_matlab", "run case.toml -o result.mat", "-o result.mat: results are a folder of files"},
      {"mesh_without_unit", "run mesh.off --ghz 10", "give --unit m, cm"},
      {"mesh_without_frequency", "run mesh.off --unit mm", "give one with --ghz"},
      {"mesh_azimuth_of_a_word", "run mesh.off --unit mm --ghz 10 --azimuth east", "--azimuth east: write a number"},
      {"unit_of_a_case", "run case.toml --unit mm", "--unit: goes with a mesh"},
      {"unknown_command", "fly case.toml", "unknown command \"fly\"; choose among run, "},
      {"command_in_capitals", "RUN case.toml", "unknown command \"RUN\"; did you mean \"run\"?"},
      {"command_of_1e5_letters", std::string(100000, 'f'), "unknown command \"fff"},
      {"option_unknown", "run case.toml --fast", "--fast; see raytube run --help"},
      {"check_threads_none", "check case.toml --threads 0", "--threads"},
      {"option_of_another_command", "check case.toml --parts", "--parts; see raytube check --help"},
      {"two_cases", "run case.toml case.toml", "case.toml; see raytube run --help"},
      {"run_without_case", "run", "case is required; see raytube run --help"},
      {"threads_zero", "run case.toml --threads 0", "--threads: "},
      {"threads_negative", "run case.toml --threads -1", "--threads: "},
      {"threads_1e9", "run case.toml --threads 1000000000", "--threads: "},
      {"threads_beyond_64_bits", "run case.toml --threads 99999999999999999999", "--threads"},
      {"threads_half", "run case.toml --threads 1.5", "--threads: "},
      {"threads_without_number", "run case.toml --threads", "--threads: "},
      {"set_without_word", "run case.toml --set", "--set: "},
      {"output_without_word", "run case.toml -o", "--output: "},
      {"launch_random", "run case.toml --launch random --samples 5", "--launch random is gone; the Monte Carlo baseline is"},
      {"trace_without_look", "trace case.toml --u 0 --v 0", "--look is required; see"},
      {"trace_look_negative", "trace case.toml --look -1 --u 0 --v 0", "--look: "},
      {"trace_look_beyond", "trace case.toml --look 7 --u 0 --v 0", "1 direction pair"},
      {"trace_beside_the_target", "trace case.toml --look 0 --u 1e300 --v 0", "--u"},
      {"trace_at_infinity", "trace case.toml --look 0 --u inf --v 0", "must be finite"},
      {"trace_at_a_word", "trace case.toml --look 0 --u here --v 0", "--u = here; see raytube trace --help"},
      {"trace_of_nothing", "trace case.toml --look 0", "--u is required, with --v and --look; see raytube trace --help"},
      {"trace_without_v", "trace case.toml --look 0 --u 0", "--v is required, with --u and --look; see raytube trace --help"},
      {"trace_of_all_without_v", "trace case.toml --look 0 --all --u 0", "--v is required, with --u and --look; see"},
      {"trace_of_all_beyond", "trace case.toml --look 7 --all", "1 direction pair"},
      {"trace_of_all_edge_on", "trace case.toml --look 0 --all --set look.theta_deg=90",
       "the target has no projected area in this look; choose another --look"},
      {"paths_without_all", "trace case.toml --look 0 --u 0 --v 0 --paths paths.vtp", "--paths requires --all; see"},
      {"hits_without_all", "trace case.toml --look 0 --u 0 --v 0 --hits hits.vtu", "--hits requires --all; see"},
      {"tubes_without_all", "trace case.toml --look 0 --u 0 --v 0 --tubes 10", "--tubes requires --all; see"},
      {"tubes_none", "trace case.toml --look 0 --all --tubes 0", "--tubes: needs a whole number from 1 to 1000000 (found 0)"},
      {"tubes_half", "trace case.toml --look 0 --all --tubes 1.5", "--tubes: needs a whole number from 1"},
      {"paths_without_name", "trace case.toml --look 0 --all --paths ''", "needs the name of a file; see"},
      {"paths_of_another_ending", "trace case.toml --look 0 --all --paths paths.vtu",
       "--paths paths.vtu: must end in .vtp, by which ParaView recognises"},
      {"hits_of_another_ending", "trace case.toml --look 0 --all --hits hits.csv",
       "--hits hits.csv: must end in .vtu, by which ParaView recognises"},
      {"trace_of_rays_without_u", "trace case.toml --look 0 --v 0 --surface-rays rays.vtp", "--u is required, with --v"},
      {"trace_of_rays_without_name", "trace case.toml --look 0 --surface-rays ''", "needs the name of a file; see"},
      {"trace_of_rays_beyond", "trace case.toml --look 7 --surface-rays rays.vtp", "1 direction pair"},
      {"trace_of_rays_over_flat_faces", "trace case.toml --look 0 --surface-rays rays.vtp",
       "--surface-rays: case.toml has no waves over curved surfaces: no curved surface; leave out the option, or"},
      {"trace_of_rays_switched_off", "trace case.toml --look 0 --surface-rays rays.vtp --set surfaces.waves=false",
       "no waves over curved surfaces: surfaces.waves is false; leave"},
      {"converge_two_densities", "converge case.toml --densities 4,8",
       "at least three different densities are needed; write for example"},
      {"converge_no_densities", "converge case.toml --densities ''", "--densities : write tubes per wavelength"},
      {"converge_density_nan", "converge case.toml --densities 4,nan,16", "--densities 4,nan,16: write tubes per wavelength"},
      {"converge_density_1e300", "converge case.toml --densities 4,8,1e300", "1e+300 tubes per wavelength are more than 10^6"},
      {"converge_10000_densities",
       "converge case.toml --densities " +
           [] {
             std::string s = "1";
             for (int i = 2; i < 10000; ++i) s += "," + std::to_string(i);
             return s;
           }(),
       "--densities"},
  };
}

const std::string scene =
    "[scene]\nbox_m = [[-2, -2, -2], [2, 2, 2]]\n[[scene.parts]]\nname = \"plate\"\nmesh = \"mesh.off\"\nunit = \"m\"\nsurface = "
    "\"pec\"\n"
    "[source]\npoint_m = [0.5, 0.5, 1]\nrays = [100, 1000]\ncounted = \"plate\"\n";

BadRow sources(const std::string& name, const std::string& values, const std::string& says) {
  BadRow row = with_file(name, "scene.toml", scene, "sources scene.toml --set '" + values + "'", says);
  row.place.clear();  // the option, which the sentence has
  return row;
}

std::vector<BadRow> sources_rows() {
  return {
      {"sources_of_a_run_case", "sources case.toml", "line 4: [frequency] belongs to a case for raytube run; run it"},
      sources("sources_no_rays", "source.rays=[]", "source.rays is an empty list; give at least one"),
      sources("sources_1e12_rays", "source.rays=1e12", "source.rays must be a whole number from 1 to"),
      sources("sources_negative_rays", "source.rays=-5", "source.rays must be a whole number from 1 to"),
      sources("sources_rays_twice", "source.rays=[5,5]", "source.rays gives a number twice; give it once"),
      sources("sources_seed_half", "source.seed=0.5", "source.seed must be a whole number from 0 to 2^53"),
      sources("sources_model_unknown", "source.models=sphere", "source.models \"sphere\" is unknown; write"),
      sources("sources_wall_unknown", "source.wall=north", "source.wall \"north\" is unknown; write"),
      sources("sources_point_nan", "source.point_m=[0,0,nan]", "source.point_m must be a finite number"),
      sources("sources_points_none", "source.point_m=[]", "source.point_m must be a list of three numbers"),
      sources("sources_box_inside_out", "scene.box_m=[[2,2,2],[-2,-2,-2]]", "scene.box_m must have its lower corner first"),
      sources("sources_box_infinite", "scene.box_m=[[-2,-2,-inf],[2,2,2]]", "scene.box_m must be a finite number"),
      sources("sources_box_1e300", "scene.box_m=[[-1e300,-2,-2],[1e300,2,2]]", "scene.box_m"),
      sources("sources_counted_unknown", "source.counted=screen",
              "source.counted \"screen\" is not a part of the scene; write plate"),
      sources("sources_parts_a_word", "scene.parts=plate", "scene.parts must be a list; write [[scene.parts]]"),
      sources("sources_parts_none", "scene.parts=[]", "no scene; add a [[scene.parts]]"),
      sources("sources_reflections_1e9", "source.max_reflections=1e9",
              "source.max_reflections must be a whole number from 0 to 1000"),
      with_file("sources_part_with_a_comma", "scene.toml", scene + "[[scene.parts]]\nname = \"a,b\"\n", "sources scene.toml",
                "line 13: scene.parts.name must be a word without blanks"),
  };
}

INSTANTIATE_TEST_SUITE_P(Looks, BadTable, ::testing::ValuesIn(looks_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Results, BadTable, ::testing::ValuesIn(result_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Images, BadTable, ::testing::ValuesIn(image_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Folders, BadTable, ::testing::ValuesIn(folder_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Places, BadTable, ::testing::ValuesIn(place_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Commands, BadTable, ::testing::ValuesIn(command_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Sources, BadTable, ::testing::ValuesIn(sources_rows()), row_name);

}  // namespace
}  // namespace raytube::testing
