// The rows of the bad-input table that are about case files and their values.
#include "program.h"
#include "table.h"

namespace raytube::testing {
namespace {

namespace fs = std::filesystem;

BadRow text(const std::string& name, const std::string& bytes, const std::string& says) {
  return with_file(name, "bad.toml", bytes, "run bad.toml", says);
}

BadRow set(const std::string& name, const std::string& values, const std::string& says) {
  std::string words = "run case.toml";
  for (std::size_t at = 0; at < values.size();) {
    const std::size_t end = std::min(values.find('|', at), values.size());
    words += " --set '" + values.substr(at, end - at) + "'";
    at = end + 1;
  }
  return {name, words, says};
}

std::string times(std::size_t count, const std::string& piece) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += piece;
  return all;
}

std::string in_utf16(const std::string& text) {
  std::string bytes = "\xFF\xFE";
  for (const char c : text) bytes += {c, '\0'};
  return bytes;
}

std::vector<BadRow> text_rows() {
  return {
      text("case_of_no_bytes", "", ": target.mesh is missing; add mesh = "),
      text("case_of_blanks", "\n \n\t\n", ": target.mesh is missing"),
      text("case_cut", good_case.substr(0, 12), ", line 2: not valid TOML; correct this line"),
      text("case_in_utf16", in_utf16(good_case), ": is text in UTF-16; save it as UTF-8"),
      text("case_matlab_range", "[look]\ntheta_deg = 0:1:40\n",
           ", line 2: not valid TOML; a range is written { start = 0, stop = 90, step = 1 }"),
      text("case_matlab_list", "[look]\ntheta_deg = [1 2 3]\n",
           ", line 2: not valid TOML; numbers of a list have commas between them"),
      text("case_matlab_comment", "% looks\n" + good_case, ", line 1: not valid TOML; a comment begins with #"),
      text("case_matlab_semicolon", "title = \"a\";\n" + good_case, ", line 1: not valid TOML; a line ends without a semicolon"),
      text("case_not_utf8", "title = \"\xE9t\xE9\"\n" + good_case, ", line 1: not valid TOML"),
      text("case_with_nul", std::string("title = \"a\0b\"\n", 14) + good_case,
           ": is a program or another binary file, not a case; give"),
      text("case_is_a_program",
           "\x7f"
           "ELF\x02\x01\x01",
           ": is a program or another binary file, not a case; give"),
      text("case_is_a_mesh", plate, ": is a mesh, not a case; write a case file (TOML) with mesh = \"bad.toml\" under [target]"),
      text("case_mesh_of_windows", "[target]\nmesh = \"C:\\Users\\me\\plate.stl\"\n",
           ", line 2: not valid TOML; in a path write / for \\, or put it in 'single quotes'; correct"),
      text("case_mesh_of_windows_in_a_list", "[target]\nmesh = [\"a.stl\", \"..\\meshes\\plate.stl\"]\n",
           ", line 2: not valid TOML; in a path write / for \\"),
      text("case_mesh_with_a_tab", "[target]\nmesh = \"a\\table.stl\"\nunit = \"m\"\n" + frequency + look,
           ", line 2: target.mesh holds a control character"),
      {"case_mesh_of_windows_in_single_quotes", "run bad.toml",
       "mesh file 'a\\plate.stl': not found; check the path, which in a case file is relative to it; write / between folders",
       [](const Scratch& scratch) {
         scratch.write("bad.toml", "[target]\nmesh = 'a\\plate.stl'\nunit = \"m\"\n" + frequency + look);
       }},
      text("case_key_twice", target + "unit = \"m\"\n" + frequency + look, ", line 4: not valid TOML"),
      text("case_section_twice", good_case + target, "not valid TOML"),
      text("case_section_unknown", good_case + "[tube]\nmode = \"uniform\"\n",
           ", line 9: unknown key \"tube.mode\"; did you mean \"tubes.mode\"?"),
      text("case_key_unknown", good_case + "[edges]\nordre = 2\n",
           ", line 10: unknown key \"edges.ordre\"; did you mean \"edges.order\"?"),
      text("case_key_in_capitals", good_case + "[Output]\nplots = false\n", "did you mean \"output.plots\"?"),
      text("case_key_of_1e5_letters", good_case + times(100000, "k") + " = 1\n", "unknown key \"look.kkk"),
      text("case_key_without_section", "mesh = \"mesh.off\"\n" + frequency + look,
           ", line 1: unknown key \"mesh\"; did you mean \"target.mesh\"?"),
      text("case_section_is_a_number", "tubes = 3\n" + good_case, ", line 1: tubes must be a section; write [tubes]"),
      text("case_sections_in_a_list", "[[target]]\nmesh = \"mesh.off\"\nunit = \"m\"\n" + frequency + look,
           ", line 1: target must be a section"),
      text("case_lists_1e5_deep", "title = " + times(100000, "["), "not valid TOML"),
      text("case_closed_lists_1e4_deep", "title = " + times(10000, "[") + times(10000, "]"), "not valid TOML"),
      text("case_tables_1e5_deep", times(100000, "a.") + "a = 1\n", ", line 1: a key of more than"),
      text("case_section_1e5_deep", "\n[" + times(100000, "a.") + "a]\n", ", line 2: a key of more than"),
      text("case_inline_tables_1e5_deep", "title = {" + times(100000, "a.") + "a=1}\n", ", line 1: a key of more than"),
      text("case_date_for_a_number", target + "[frequency]\nghz = 1979-05-27\n" + look,
           ", line 5: frequency.ghz must be a number, a list or"),
      text("case_of_1e7_pairs_of_places",
           target + frequency + "[radar]\nposition_m = [" + times(4000, "[0,0,3],") + "]\nreceive_position_m = [" +
               times(4000, "[0,0,3],") + "]\n",
           ", line 7: 1.6e+07 looks at 1 frequencies make 1.6e+07 rows, more than the 10000000 allowed; split the sweep"),
      text("case_for_sources", "[source]\nrays = 5\n",
           ", line 1: [source] belongs to a case for raytube sources; run it with that command"),
  };
}

std::vector<BadRow> value_rows() {
  return {
      set("unit_misspelt", "target.unit=milimetre", "target.unit \"milimetre\" is unknown; write \"m\", \"cm\", \"mm\""),
      set("unit_in_capitals", "target.unit=MM", "target.unit \"MM\" is unknown"),
      set("unit_is_a_number", "target.unit=0.001", "target.unit must be a text in double quotes"),
      set("mesh_is_a_number", "target.mesh=5", "target.mesh must be a text in double quotes"),
      set("mesh_is_empty", "target.mesh=\"\"", "target.mesh is empty; give the file of the mesh"),
      set("mesh_of_a_list_is_empty", "target.mesh=[\"mesh.off\",\"\"]",
          ": entry 2 of target.mesh is empty; give the file of the mesh"),
      set("mesh_is_a_blank", "target.mesh=\" \"", "mesh file ' ': not found; check the path"),
      set("material_empty", "target.material=\"\"", "target.material is empty; write \"pec\", \"absorber\" or the NAME"),
      set("material_without_name", "materials.\"\".kind=pec", "a material has no name; write [materials.NAME]"),
      set("part_without_name", "target.parts={\"\"=\"pec\"}", "target.parts has a part without a name; give"),
      set("part_without_material", "target.parts={a=\"\"}", "target.parts.a is empty; write \"pec\""),
      set("material_unknown", "target.material=steel",
          "target.material \"steel\" is no material; add [materials.steel], or choose among pec, absorber"),
      set("frequency_text", "frequency.ghz=\"10\"", "frequency.ghz must be a number, a list or { start, stop, step } (or count)"),
      set("frequency_zero", "frequency.ghz=0", "frequency.ghz must be greater than 0 (found 0)"),
      set("frequency_of_a_list_negative", "frequency.ghz=[1,-2]", "frequency.ghz must be greater than 0 (found -2)"),
      set("frequency_nan", "frequency.ghz=nan", "frequency.ghz must be a finite number"),
      set("frequency_1e300", "frequency.ghz=1e300", "frequency.ghz is too large (found 1e+300): above 1e+09"),
      set("frequency_1e_300", "frequency.ghz=1e-300",
          "frequency.ghz is too small (found 1e-300): below 1e-06 (1 kHz) there are no"),
      set("frequency_least_number", "frequency.ghz=5e-324", "frequency.ghz is too small (found 5e-324)"),
      set("frequency_1e10", "frequency.ghz=1e10",
          "frequency.ghz is too large (found 10000000000): above 1e+09 waves are shorter"),
      set("frequency_list_with_a_tiny_one", "frequency.ghz=[10,1e-40]", "frequency.ghz is too small (found 1e-40)"),
      set("frequency_steps_below_rounding", "frequency.ghz={start=10,stop=10.0000000000001,count=1000}",
          "which numbers of the size of 10.0000000000001 do not resolve; choose larger steps"),
      set("frequency_no_values", "frequency.ghz=[]", "frequency.ghz is an empty list; give at least one number"),
      set("frequency_list_of_lists", "frequency.ghz=[[1,2]]", "every entry of frequency.ghz must be a number"),
      set("frequency_count_zero", "frequency.ghz={start=1,stop=2,count=0}",
          "frequency.ghz.count must be a whole number of at least 1"),
      set("frequency_count_one_of_two", "frequency.ghz={start=1,stop=2,count=1}",
          "frequency.ghz.count of 1 cannot hold both start and stop; write"),
      set("frequency_count_half", "frequency.ghz={start=1,stop=2,count=2.5}", "must be a whole number of at least 1 (found 2.5)"),
      set("frequency_count_1e12", "frequency.ghz={start=1,stop=2,count=1e12}",
          "asks for 1e+12 values, more than the 1000000 allowed; choose another count"),
      set("frequency_with_step_and_count", "frequency.ghz={start=1,stop=2,step=1,count=2}",
          "frequency.ghz has both a step and a count; leave one of them out"),
      set("frequency_with_a_half_step", "frequency.ghz={start=1,stop=2,half=1}", "unknown key \"frequency.ghz.half\"; write"),
      set("frequency_without_stop", "frequency.ghz={start=1,count=3}", "frequency.ghz has no stop; write"),
      set("theta_below_zero", "look.theta_deg=-1e-9", "look.theta_deg must be from 0 to 180 degrees"),
      set("elevation_beside_theta", "look.elevation_deg=3",
          "look.elevation_deg and look.theta_deg both give the same angle; remove"),
      set("azimuth_beside_phi", "look.azimuth_deg=3", "look.azimuth_deg and look.phi_deg both give the same angle; remove"),
      set("elevation_of_91", "receive.elevation_deg=91|receive.azimuth_deg=0",
          "receive.elevation_deg must be from -90 to 90 degrees"),
      set("frequency_twice", "frequency.ghz=[10,9,10]", "frequency.ghz has 10 twice; give each frequency once"),
      set("theta_is_an_elevation", "look.theta_deg={start=-30,stop=30,step=1}",
          "look.theta_deg must be from 0 to 180 degrees, from +z (found -30); theta is 90 - elevation: for an elevation of -30 "
          "write "
          "120"),
      set("theta_text", "look.theta_deg=up", "look.theta_deg must be a number, a list or { start, stop, step } (or count)"),
      set("theta_true", "look.theta_deg=true", "look.theta_deg must be a number, a list or"),
      set("theta_range_of_matlab", "look.theta_deg=0:0.5:90",
          "look.theta_deg must be a number, a list or { start, stop, step } (or count); for 0:0.5:90 write { start = 0, stop = "
          "90, step = "
          "0.5 }"),
      set("phi_range_of_matlab_by_one", "look.phi_deg=-3:3", "for -3:3 write { start = -3, stop = 3, step = 1 }"),
      set("phi_range_of_four_parts", "look.phi_deg=0:1:2:3",
          "look.phi_deg must be a number, a list or { start, stop, step } (or count)\n"),
      set("frequency_range_of_matlab", "frequency.ghz=92:0.5:94",
          "frequency.ghz must be a number, a list or { start, stop, step } (or count); for 92:0.5:94 write { start = 92, stop = "
          "94, "
          "step = 0.5 }"),
      set("phi_range_of_steps_zero_with_colons", "look.phi_deg=0:0:3", "or { start, stop, step } (or count)\n"),
      set("frequency_range_that_ends_early", "frequency.ghz=1:0.3:2", "write { start = 1, stop = 1.9, step = 0.3 }"),
      set("phi_no_values", "look.phi_deg=[]", "look.phi_deg is an empty list; give at least one number"),
      set("phi_infinite", "look.phi_deg=-inf", "look.phi_deg must be a finite number"),
      set("phi_1e308", "look.phi_deg=1e308",
          "look.phi_deg is 1e+308, too large for an angle in double precision; write an angle from -360 to 360"),
      set("phi_1e10_of_a_list", "look.phi_deg=[0,-1e10]", "look.phi_deg is -10000000000, too large for an angle"),
      set("phi_1e300_of_a_receiver", "receive.theta_deg=3|receive.phi_deg=1e300", "receive.phi_deg is 1e+300, too large"),
      set("phi_range_of_1e200", "look.phi_deg={start=1e200,stop=2e200,step=1e200}", "look.phi_deg is 1e+200, too large"),
      set("phi_range_below_rounding", "look.phi_deg={start=1e6,stop=1000000.000001,step=1e-8}",
          "look.phi_deg has steps of 1e-08, which numbers of the size of 1000000.000001 do not resolve; choose larger steps"),
      set("theta_range_of_1e_301", "look.theta_deg={start=0,stop=1e-300,step=1e-301}",
          "look.theta_deg has steps of 1e-301, finer than any direction; write at least 1e-12 degrees"),
      set("theta_1e308", "look.theta_deg=1e308", "look.theta_deg is 1e+308, too large"),
      set("phi_range_without_end", "look.phi_deg={start=0,stop=inf,step=1}", "look.phi_deg.stop must be a finite number"),
      set("phi_range_of_steps_zero", "look.phi_deg={start=0,stop=1,step=0}", "look.phi_deg.step must not be zero; write"),
      set("phi_range_of_steps_1e_320", "look.phi_deg={start=0,stop=1,step=1e-320}",
          "more than the 1000000 allowed; choose another step"),
      set("phi_range_the_wrong_way", "look.phi_deg={start=5,stop=1,step=0.5}",
          "look.phi_deg.step 0.5 leads away from stop (start 5, stop 1); write step = -0.5"),
      set("phi_range_of_1e12_steps", "look.phi_deg={start=0,stop=1e6,step=1e-6}",
          "asks for 1e+12 values, more than the 1000000 allowed"),
      set("phi_range_of_doubles_ends", "look.phi_deg={start=-1.7e308,stop=1.7e308,step=1}",
          "more than the 1000000 allowed; choose another step"),
      set("looks_in_1e7_rows", "look.theta_deg={start=0,stop=180,step=0.01}|look.phi_deg={start=0,stop=360,step=0.01}",
          "rows, more than the 10000000 allowed; split the sweep: 10000000 looks would fit"),
      set("receive_without_phi", "receive.theta_deg=3", "receive.phi_deg is missing; add"),
      set("tubes_mode_unknown", "tubes.mode=\"random\"", "tubes.mode \"random\" is unknown; write \"uniform\" or \"adaptive\""),
      set("tubes_mode_is_a_list", "tubes.mode=[\"uniform\"]", "tubes.mode must be a text"),
      set("tubes_density_negative", "tubes.per_wavelength=-1e-300", "tubes.per_wavelength must be at least 0.001"),
      set("tubes_density_1e_300", "tubes.per_wavelength=1e-300", "tubes.per_wavelength must be at least 0.001 (found 1e-300)"),
      set("tubes_density_1e_300_uniform", "tubes.mode=uniform|tubes.per_wavelength=1e-300",
          "tubes.per_wavelength must be at least 0.001 (found 1e-300)"),
      set("tubes_density_infinite", "tubes.per_wavelength=+inf", "tubes.per_wavelength must be a finite number"),
      set("tubes_density_1e308_uniform", "tubes.mode=uniform|tubes.per_wavelength=1e308", "tubes.per_wavelength"),
      set("bounces_zero", "tubes.max_bounces=0", "tubes.max_bounces must be a whole number from 1 to 1000 (found 0)"),
      set("bounces_1e9", "tubes.max_bounces=1e9", "tubes.max_bounces must be a whole number from 1 to 1000"),
      set("bounces_beyond_64_bits", "tubes.max_bounces=9223372036854775808", "tubes.max_bounces must be a number"),
      set("up_zero", "tubes.up=[0,0,0]", "tubes.up must not be the zero vector; write"),
      set("up_of_two_numbers", "tubes.up=[0,1]", "tubes.up must be a list of three numbers"),
      set("up_too_long", "tubes.up=[1e200,1e200,0]", "tubes.up"),
      set("up_too_short", "tubes.up=[0,0,1e-200]", "tubes.up"),
      set("clip_is_gone", "tubes.clip=false",
          "unknown key \"tubes.clip\"; adaptive tubes always end exactly at edges; remove it"),
      set("skip_is_a_number", "tubes.skip=1", "tubes.skip must be true or false, without quotes"),
      set("curved_unknown", "tubes.curved=concave", "tubes.curved \"concave\" is unknown; write"),
      set("tolerance_zero", "accuracy.tolerance_db=0", "accuracy.tolerance_db must be greater than 0"),
      set("model_share_below_zero", "accuracy.model_share=-0.1", "accuracy.model_share must be from 0 to 1 (found -0.1)"),
      set("model_share_in_percent", "accuracy.model_share=25", "accuracy.model_share must be from 0 to 1 (found 25)"),
      set("model_share_of_uniform_tubes", "tubes.mode=uniform|accuracy.model_share=0.1",
          "accuracy.model_share needs adaptive tubes; "),
      set("tolerance_nan", "accuracy.tolerance_db=nan", "accuracy.tolerance_db must be a finite number"),
      set("edges_unknown", "edges.method=ptd", "edges.method \"ptd\" is unknown; write"),
      set("edges_order_4", "edges.order=4", "edges.order must be a whole number from 1 to 3 (found 4)"),
      set("edges_order_half", "edges.order=1.5", "edges.order must be a whole number from 1 to 3 (found 1.5)"),
      set("edges_wedge_of_180", "edges.min_wedge_deg=180", "edges.min_wedge_deg must be at least 0 and less than 180"),
      set("edges_wedge_negative", "edges.min_wedge_deg=-1", "edges.min_wedge_deg must be at least 0"),
      set("edges_transition_is_no_key", "edges.transition=exact", "unknown key \"edges.transition\"; choose among edges.method"),
      set("utd_range_without_utd", "edges.utd_range_m=5", "edges.utd_range_m needs edges.method = \"utd\"; "),
      set("between_neither", "edges.between=maybe", "edges.between must be true, false or \"auto\""),
      set("surface_waves_neither", "surfaces.waves=1", "surfaces.waves must be true, false or \"auto\""),
      set("between_budget_negative", "edges.between_budget=-1", "edges.between_budget must be at least 0 (found -1)"),
      set("between_budget_infinite", "edges.between_budget=inf", "edges.between_budget must be a finite number"),
      set("utd_range_1e300", "edges.method=utd|edges.utd_range_m=1e300",
          "edges.utd_range_m must be greater than 0 and at most 1e+12 (found 1e+300)"),
      set("utd_range_nan", "edges.method=utd|edges.utd_range_m=nan", "edges.utd_range_m must be a finite number"),
      set("radar_range_negative", "radar.range_m=-3", "radar.range_m must be greater than 0 and at most 1e+12 (found -3)"),
      set("radar_range_1e13", "radar.range_m=1e13", "radar.range_m must be greater than 0 and at most 1e+12"),
      set("radar_without_range", "radar.beamwidth_deg=3", "radar.range_m is missing; give"),
      set("radar_position_and_look", "radar.position_m=[0,0,3]",
          "[look] cannot be combined with radar.position_m, which says where the antenna stands; remove one"),
      set("radar_beam_nan", "radar.range_m=3|radar.beamwidth_deg=nan", "radar.beamwidth_deg must be a finite number"),
      set("radar_beam_of_1e_300", "radar.range_m=3|radar.beamwidth_deg=1e-300",
          "radar.beamwidth_deg must be from 1e-06 to 180 (found 1e-300)"),
      set("radar_beam_of_180_and_more", "radar.range_m=3|radar.beamwidth_deg=[10,181]",
          "every entry of radar.beamwidth_deg must be from 1e-06 to 180 (found 181)"),
      set("radar_pattern_empty", "radar.range_m=3|radar.pattern_csv=\"\"",
          "radar.pattern_csv is empty; give the file of the antenna pattern"),
      set("radar_beam_of_no_values", "radar.range_m=3|radar.beamwidth_deg=[]",
          "radar.beamwidth_deg must be one angle, or [azimuth, elevation]"),
      set("radar_aim_text", "radar.range_m=3|radar.aim_m=target", "radar.aim_m must be a list of three numbers"),
      set("receive_aim_of_one_antenna", "radar.range_m=3|radar.receive_aim_m=[0,0,0.1]",
          "radar.receive_aim_m needs a receiver of its own; add [receive] or radar.receive_position_m, or remove it"),
      set("receive_aim_behind", "radar.range_m=3|receive.theta_deg=0|receive.phi_deg=0|radar.receive_aim_m=[0,0,4]",
          "radar.receive_aim_m lies at a receiver, or behind one; give a point on the side of the target"),
      set("turntable_in_the_far_field", "radar.turntable_deg=[0,10]", "radar.range_m is missing; give"),
      set("turntable_of_1e300", "radar.range_m=3|radar.turntable_deg=1e300", "radar.turntable_deg"),
      set("turntable_without_its_unit", "radar.range_m=3|radar.turntable=5", "did you mean \"radar.turntable_deg\"?"),
      set("power_without_gain", "radar.range_m=3|radar.transmit_power_dbm=30",
          "radar.transmit_power_dbm and radar.gain_dbi go together; give both, or remove one"),
      set("gain_nan", "radar.range_m=3|radar.transmit_power_dbm=30|radar.gain_dbi=nan", "radar.gain_dbi must be a finite number"),
      set("power_of_no_radar", "output.power_dbm=true",
          "output.power_dbm needs radar.transmit_power_dbm and radar.gain_dbi; add them, or remove it"),
      set("ground_height_text", "ground.height_m=low", "ground.height_m must be a number"),
      set("ground_height_1e300", "ground.height_m=-1e300", "ground.height_m must be less than 1e+12 m from the origin"),
      set("ground_in_the_target", "ground.height_m=0.5",
          "below the ground at 0.5 m; lower ground.height_m, or cut the mesh there"),
      set("ground_unknown_key", "ground.heigth_m=0", "unknown key \"ground.heigth_m\"; did you mean \"ground.height_m\"?"),
      set("ground_of_what", "ground.material=soil",
          "ground.material \"soil\" is neither \"pec\" nor in [materials]; choose among pec"),
      set("ground_of_a_sheet", "ground.material=film|materials.film={kind=\"sheet\",resistance_ohm=100}",
          "ground.material is a sheet, which has another side; write kind = "),
      set("ground_from_below", "ground.height_m=0|look.theta_deg=[10,91]",
          "look 1 has theta = 91 degrees, from below the ground; leave out angles above 90"),
      set("medium_from_the_horizon", "ground.material=wet|materials.wet={kind=\"dielectric\",eps_r=[5,1]}|look.theta_deg=90",
          "look 0 has theta = 90 degrees, where nothing is left of waves over a medium; leave out the horizon"),
      set("ground_above_the_antenna", "ground.height_m=-0.5|radar.range_m=3|look.theta_deg=120",
          "look 0 has an antenna at z = -1.5 m, not above the ground at -0.5 m; move it up, or lower ground.height_m"),
      set("ground_and_rough",
          "ground.height_m=0|output.incoherent=true|target.material=r|materials.r={kind=\"pec\",roughness_rms_mm=1}",
          "remove [ground]"),
      set("image_look_negative", "output.image_look=-1",
          "output.image_look -1: the case has 1 direction pair(s), counted from 0; "),
      set("image_look_1e300", "output.image_look=1e300", "the case has 1 direction pair(s)"),
      set("image_looks_none", "output.image_look=[]", "output.image_look is an empty list; give at least one"),
      set("image_density_1e300", "output.image_look=0|output.image_per_wavelength=1e300",
          "output.image_per_wavelength: 1e+300 cells per wavelength are more than 4000000 in look 0; "),
      set("image_density_1e_300", "output.image_look=0|output.image_per_wavelength=1e-300",
          "output.image_per_wavelength must be at least 0.001 (found 1e-300)"),
      set("image_density_negative", "output.image_per_wavelength=-1", "output.image_per_wavelength must be at least 0.001"),
      set("plots_text", "output.plots=\"yes\"", "output.plots must be true or false, without quotes"),
      set("title_is_a_number", "title=5", "title must be a text in double quotes"),
  };
}

// What `run` refuses `check` refuses too, in the same words: the plate is 1 m wide here and the wavelength 0.03 m, or as given.
std::vector<BadRow> verdict_rows() {
  std::vector<BadRow> rows;
  for (const std::string command : {"run", "check"}) {
    const auto refused = [&](const std::string& name, const std::string& values, const std::string& says) {
      rows.push_back({command + "_" + name, command + " case.toml --set target.unit=m " + values, says, [](const Scratch&) {},
                      "case.toml: "});
    };
    refused(
        "frequency_of_a_petahertz", "--set frequency.ghz=1e6",
        "tubes.per_wavelength: 10 tubes per wavelength are more than 10^6 along one side of the launch plane; 0.299 would fit");
    refused("uniform_tubes_too_dense", "--set tubes.mode=uniform --set tubes.per_wavelength=29990",
            "29990 tubes per wavelength are more than 10^6 along one side of the launch plane; 29900 would fit");
    refused("image_too_dense", "--set output.image_look=0 --set output.image_per_wavelength=60.5",
            "60.5 cells per wavelength are more than 4000000 in look 0; 60.3 would fit");
    refused("antenna_in_the_target", "--set radar.range_m=0.5",
            "an antenna 0.5 m from the mesh's origin stands beside the target");
    refused("ray_range_in_the_target", "--set edges.method=utd --set edges.utd_range_m=0.1", "edges.utd_range_m is 0.1 m, but");
  }
  return rows;
}

// Words of other programs, and names far from all others.
std::vector<BadRow> word_rows() {
  const std::string phi = "write look.azimuth_deg (or look.phi_deg), from +x towards +y",
                    theta = "write look.elevation_deg, or look.theta_deg = 90 - elevation, the angle from +z",
                    channels = "all four channels, VV, VH, HV and HH, are always computed; remove it";
  return {
      set("word_azimuth", "look.azimuth=5", "unknown key \"look.azimuth\"; " + phi),
      set("word_azimuth_deg", "azimuth_deg=5", "unknown key \"azimuth_deg\"; " + phi),
      set("word_elevation", "look.Elevation=5", "unknown key \"look.Elevation\"; " + theta),
      set("word_elevation_as_a_section", "elevation.start=5", "a range is one value; write for example phi_deg = { start"),
      set("word_scale", "target.scale=0.001", "unknown key \"target.scale\"; target.unit is the length of one mesh unit; write"),
      set("word_polarization", "look.polarization=VV", "unknown key \"look.polarization\"; " + channels),
      set("word_polarisation", "polarisation=HH", "unknown key \"polarisation\"; " + channels),
      set("word_vv", "output.VV=true", "unknown key \"output.VV\"; " + channels),
      set("word_polarisation_of_the_transmitter", "polarisation.tx=V", channels),
      set("word_start", "frequency.start=8", "a range is one value; write for example"),
      set("word_threads", "threads=4", "it is an option of the command line; write --threads N there"),
      set("name_far_from_all_of_a_section", "look.zenith=4",
          "unknown key \"look.zenith\"; choose among look.theta_deg, look.phi_deg, look.azimuth_deg, look.elevation_deg, "
          "look.looks_csv"),
      set("name_far_from_all", "solver.zenith=4", "unknown key \"solver.zenith\"; choose among title, target, materials, freq"),
      set("name_with_another_unit", "radar.range_mm=4", "did you mean \"radar.range_m\", which has another unit?"),
      set("slip_beside_a_unit", "tubes.max_bounce=4", "did you mean \"tubes.max_bounces\"?"),
      set("name_without_unit", "look.theta=4", "unknown key \"look.theta\"; did you mean \"look.theta_deg\"?"),
      set("part_far_from_all", "target.parts.wing=pec", "target.parts.wing is not a name in the mesh; choose among mesh.off"),
  };
}

// A case with this section [motion].
BadRow motion(const std::string& name, const std::string& section, const std::string& says) {
  return text("motion_" + name, good_case + "[motion]\n" + section, says);
}

std::vector<BadRow> motion_rows() {
  const std::string pulses = "pulses = { interval_s = 1e-3, count = 4 }\n", body = pulses + "[motion.bodies.a]\n";
  return {
      motion("empty", "", "[motion] does not say when; add pulses = {"),
      motion("twice_when", pulses + "times_s = 0\n", "motion.times_s and motion.pulses both say when"),
      motion("no_interval", "pulses = { count = 4 }\n", "motion.pulses.interval_s is missing"),
      motion("interval_in_ms", "pulses = { interval_ms = 1, count = 4 }\n",
             "unknown key \"motion.pulses.interval_ms\"; did you mean \"interval_s\"?"),
      motion("interval_0", "pulses = { interval_s = 0, count = 4 }\n", "interval_s must be greater than 0"),
      motion("half_a_pulse", "pulses = { interval_s = 1, count = 1.5 }\n", "motion.pulses.count must be a whole number"),
      motion("endless", "pulses = { interval_s = 1, count = 1e8 }\n", "motion.pulses.count must be a whole number from 1 to"),
      motion("pulses_at_one_time", "pulses = { start_s = 1e9, interval_s = 1e-9, count = 4 }\n",
             "motion.pulses.interval_s must be longer than what numbers as large as start_s tell apart"),
      motion("half_a_turn", body + "poses = [[0, 0, 0, 0, 1, 0, 0, 0], [1, 0, 0, 0, 0, 1, 0, 0]]\n",
             "is turned by more than 150 degrees against the pose before"),
      motion("through_the_ground", pulses + "[motion.bodies.a]\nvelocity_m_per_s = [0, 0, -1]\n[ground]\nheight_m = -0.0025\n",
             "below the ground at -0.0025 m; lower ground.height_m, or cut the mesh there (at 0.003 s)"),
      motion("into_the_antenna", body + "velocity_m_per_s = [0, 0, 400]\n[radar]\nrange_m = 1\n",
             "stands beside the target, or too near to it, to have all of it and the origin in front, within 45 degrees of the "
             "line to its middle; move it away (radar.range_m, radar.position_m), or check target.unit (at 0.00"),
      motion("times_fall", "times_s = [1, 0]\n", "motion.times_s must ascend"),
      motion("bodies_no_table", pulses + "bodies = 3\n", "motion.bodies must be a section; write [motion.bodies.NAME]"),
      motion("body_no_table", pulses + "bodies = { a = 3 }\n", "motion.bodies.a must be a section"),
      motion("speed_in_km_per_h", body + "velocity_km_per_h = [1, 0, 0]\n", "unknown key \"motion.bodies.a.velocity_km_per_h\""),
      motion("speed_a_number", body + "velocity_m_per_s = 3\n", "motion.bodies.a.velocity_m_per_s"),
      motion("no_axis", body + "rev_per_min = 3\n", "motion.bodies.a.axis is missing; write for example axis = [0, 0, 1]"),
      motion("axis_0", body + "axis = [0, 0, 0]\nrev_per_min = 3\n", "motion.bodies.a.axis must not be the zero vector"),
      motion("axis_of_nothing", body + "axis = [0, 0, 1]\n", "motion.bodies.a.axis turns nothing; add rev_per_min"),
      motion("two_rates", body + "axis = [0, 0, 1]\nrev_per_min = 3\ndeg_per_s = 3\n", "deg_per_s and rev_per_min say the same"),
      motion("no_such_part", body + "parts = \"wheel\"\n",
             "\"wheel\" is not a name in the mesh; there are no names to choose among"),
      motion("no_parts", body + "parts = []\n", "motion.bodies.a.parts is an empty list"),
      motion("on_nothing", body + "on = \"b\"\n", "motion.bodies.a.on \"b\" is not in [motion.bodies]"),
      motion("on_itself", body + "on = \"a\"\n", "bodies carry one another in a circle"),
      motion("two_rests", body + "[motion.bodies.b]\n", "motion.bodies.a and motion.bodies.b both name no parts"),
      motion("one_pose", body + "poses = [[0, 0, 0, 0]]\n", "must be a list of at least two poses [time_s, x_m,"),
      motion("poses_fall", body + "poses = [[1, 0, 0, 0], [0, 0, 0, 0]]\n", "times must ascend"),
      motion("no_unit_quaternion", body + "poses = [[0, 0, 0, 0, 1, 1, 0, 0], [1, 0, 0, 0, 1, 0, 0, 0]]\n",
             "must make a unit quaternion"),
      motion("poses_too_short", body + "poses = [[0, 0, 0, 0], [0.002, 1, 0, 0]]\n",
             "has poses from 0 s to 0.002 s, but [motion] asks for 0.003 s"),
      motion("no_table_of_poses", body + "poses_csv = \"of_bad.toml\"\n",
             "poses_csv must name a readable CSV file with the header time_s,"),
      motion("track_of_nothing", pulses + "[motion.radar]\nvelocity_m_per_s = [1, 0, 0]\n",
             "[motion.radar] moves antennas from radar.position_m"),
      motion("and_images", pulses + "[output]\nimage_look = 0\n", "output.image_look needs a scene that stands"),
      with_file("motion_centres", "bad.toml", good_case + "[motion]\n" + pulses, "centres bad.toml",
                "this needs a scene that stands"),
      with_file("motion_converge", "bad.toml", good_case + "[motion]\n" + pulses, "converge bad.toml",
                "this needs a scene that stands"),
  };
}

std::vector<BadRow> override_rows() {
  return {
      set("set_without_value", "tubes.mode", "--set tubes.mode: no KEY=VALUE; write"),
      set("set_without_key", "=5", "--set =5: no KEY=VALUE; write"),
      set("set_only_equals", "=", "--set =: no KEY=VALUE"),
      set("set_nothing", " ", "no KEY=VALUE; write"),
      set("set_key_of_dots", "...=1", "\"...\" is not a dotted key; write"),
      set("set_key_with_blank", "tubes mode=uniform", "\"tubes mode\" is not a dotted key; write"),
      set("set_key_is_a_comment", "#tubes.mode=uniform", "\"#tubes.mode\" is not a dotted key; write"),  // found by fuzzing
      set("set_key_is_a_section", "[tubes]#=uniform", "\"[tubes]#\" is not a dotted key; write"),
      set("set_key_not_ascii",
          "tubes.m\xC3\xB6"
          "de=1",
          "is not a dotted key"),
      set("set_key_unknown", "tubes.per_wavelenght=5",
          "--set tubes.per_wavelenght=5: unknown key \"tubes.per_wavelenght\"; did you mean \"tubes.per_wavelength\"?"),
      set("set_section", "tubes=5", "tubes must be a section"),
      set("set_section_as_a_table", "tubes={mode=\"uniform\",speed=3}", "unknown key \"tubes.speed\""),
      set("set_key_below_a_key", "frequency.ghz.more.less=5", "unknown key \"frequency.ghz.more\"; write"),
      set("set_key_1e5_deep", times(50000, "a.") + "a=1", "a key of more than"),
      set("set_value_of_1e5_lists", "look.phi_deg=" + times(100000, "["), "look.phi_deg must be"),
      set("set_two_lines", "tubes.mode=a\ntubes.skip=true",
          "--set tubes.mode=a?tubes.skip=true: holds a line break; write KEY=VALUE in one line"),
      set("set_line_break_behind", "tubes.mode=uniform\n", "--set tubes.mode=uniform?: holds a line break; write"),
      set("set_line_break_in_the_key", "tubes.mode\n=uniform", "--set tubes.mode?=uniform: holds a line break; write"),
      set("set_carriage_return", "tubes.mode=uniform\r", "--set tubes.mode=uniform?: holds a line break; write"),
      set("set_comment", "tubes.mode=#uniform", "tubes.mode \"#uniform\" is unknown; write"),
      set("set_not_utf8", "title=\xFF\xFE", "--set title=??: is not text in UTF-8"),
  };
}

std::vector<BadRow> file_rows() {
  return {
      {"case_missing", "run none.toml", "none.toml: no such file; give the path of a case file"},
      {"case_by_a_windows_path", "run 'cases\\none.toml'",
       "none.toml: no such file; give the path of a case file (TOML); write / "},
      {"case_is_the_mesh", "run mesh.off", "mesh.off: a mesh has no unit of length; give --unit"},
      {"case_is_the_program", "run " RAYTUBE_PROGRAM, "raytube: is"},
      {"case_folder", "run .", ".: cannot be read; give the path of a readable case file"},
      {"case_below_a_file", "run case.toml/case.toml", "case.toml/case.toml: no such file"},
      {"case_endless_device", "run /dev/zero", "/dev/zero: is a pipe or a device; copy"},
      {"case_pipe", "run bad.toml", "bad.toml: is a pipe or a device; copy",
       [](const Scratch& scratch) { ASSERT_EQ(mkfifo((scratch / "bad.toml").c_str(), 0600), 0); }},
      {"case_link_to_itself", "run bad.toml", "bad.toml: no such file",
       [](const Scratch& scratch) { fs::create_symlink("bad.toml", scratch / "bad.toml"); }},
      {"case_link_to_nothing", "run bad.toml", "bad.toml: no such file",
       [](const Scratch& scratch) { fs::create_symlink("gone.toml", scratch / "bad.toml"); }},
      {"case_of_4_tebibytes", "run bad.toml", "bad.toml: is larger than any case file",
       [](const Scratch& scratch) { fs::resize_file(scratch.write("bad.toml", ""), 1ull << 42); }},
      {"case_name_of_5000_letters", "run " + std::string(5000, 'c') + ".toml", "no such file; give the path"},
      {"case_name_not_utf8", "run $'\\xff\\xfe.toml'", "no such file; give the path"},
      {"case_name_of_two_lines", "run $'no\\nfile.toml'", "no such file; give the path"},
  };
}

INSTANTIATE_TEST_SUITE_P(CaseText, BadTable, ::testing::ValuesIn(text_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(CaseValues, BadTable, ::testing::ValuesIn(value_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Verdicts, BadTable, ::testing::ValuesIn(verdict_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(CaseWords, BadTable, ::testing::ValuesIn(word_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Motion, BadTable, ::testing::ValuesIn(motion_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(Overrides, BadTable, ::testing::ValuesIn(override_rows()), row_name);
INSTANTIATE_TEST_SUITE_P(CaseFiles, BadTable, ::testing::ValuesIn(file_rows()), row_name);

}  // namespace
}  // namespace raytube::testing
