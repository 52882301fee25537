function result = raytube_read(file)
%RAYTUBE_READ  Reads a result of raytube: a netCDF file (.nc), or rcs.csv.
%
%   result = raytube_read('rcs.nc') is a structure with the fields
%
%     frequency_hz                        F x 1
%     theta_deg, phi_deg                  L x 1, of the directions to the transmitter
%     rx_theta_deg, rx_phi_deg            L x 1, to the receiver
%     range_m, rx_range_m                 L x 1, of antennas at a finite distance only
%     time_s                              L x 1, of a scene that moves only
%     S                                   L x F x 2 x 2 complex [m]: look, frequency, receive, transmit; 1 is V, 2 is H
%     sigma_dbsm, err_db, model_db        as S, real
%     attributes                          what the file says of the whole, by name
%
%   and of a netCDF file also, where it has them, error_m and model_m (as S, real), sigma_incoherent_m2 (L x F x 2, by transmit
%   polarisation), and mechanism and model_part, structures with one array as S for each mechanism, and for each part of the model
%   uncertainty. S_vh of all looks at the first frequency is result.S(:, 1, 1, 2).
%
%   Octave needs its package netcdf for .nc files (octave-netcdf in Debian).
%
%   See also RAYTUBE_PLOT.
  [~, ~, extension] = fileparts(file);
  if exist(file, 'file') ~= 2
    error('raytube:read', '%s: no such file', file);
  elseif strcmpi(extension, '.nc')
    result = read_netcdf(file);
  else
    result = read_table(file);
  end
end

function result = read_netcdf(file)
  if exist('OCTAVE_VERSION', 'builtin')
    pkg('load', 'netcdf');
  end
  try
    info = ncinfo(file);
  catch failure
    error('raytube:read', '%s: is no netCDF file (%s)', file, failure.message);
  end
  names = {info.Variables.Name};
  if ~any(strcmp(names, 'S_re'))
    error('raytube:read', '%s: is no result of raytube', file);
  end
  result.frequency_hz = reshape(ncread(file, 'frequency'), [], 1);
  for name = {'theta_deg', 'phi_deg', 'rx_theta_deg', 'rx_phi_deg', 'range_m', 'rx_range_m', 'time_s'}
    if any(strcmp(names, name{1}))
      result.(name{1}) = reshape(ncread(file, name{1}), [], 1);
    end
  end
  result.S = complex(in_order(ncread(file, 'S_re'), 4), in_order(ncread(file, 'S_im'), 4));
  for name = {'sigma_dbsm', 'err_db', 'model_db', 'error_m', 'model_m'}
    if any(strcmp(names, name{1}))
      result.(name{1}) = in_order(ncread(file, name{1}), 4);
    end
  end
  if any(strcmp(names, 'sigma_incoherent_m2'))
    result.sigma_incoherent_m2 = in_order(ncread(file, 'sigma_incoherent_m2'), 3);
  end
  if any(strcmp(names, 'mechanism'))
    S = complex(ncread(file, 'S_mechanism_re'), ncread(file, 'S_mechanism_im'));
    result.mechanism = by_name(file, 'mechanism', S);
  end
  if any(strcmp(names, 'model_part'))
    result.model_part = by_name(file, 'model_part', ncread(file, 'model_part_m'));
  end
  for attribute = info.Attributes(:)'
    result.attributes.(attribute.Name) = attribute.Value;
  end
  for variable = info.Variables(:)'  % texts too long for an attribute
    if strcmp(variable.Datatype, 'char') && numel(variable.Dimensions) == 1
      result.attributes.(variable.Name) = reshape(ncread(file, variable.Name), 1, []);
    end
  end
end

% Both programs read the last dimension first.
function values = in_order(values, dimensions)
  values = permute(values, dimensions:-1:1);
end

function parts = by_name(file, dimension, values)
  letters = ncread(file, dimension)';
  for i = 1:size(letters, 1)
    name = letters(i, letters(i, :) ~= char(0));
    parts.(strtrim(name)) = in_order(values(:, :, :, :, i), 4);
  end
end

function result = read_table(file)
  text = strrep(fileread(file), char(13), '');
  lines = strsplit(text(1:min(end, 20000)), char(10));
  comments = find(~strncmp(lines, '#', 1), 1) - 1;
  names = strsplit(lines{comments + 1}, ',');
  body = text(sum(cellfun(@numel, lines(1:comments + 1))) + comments + 2:end);
  values = sscanf(strrep(strtrim(body), char(10), ','), '%f,', [numel(names), Inf])';
  column = @(name) values(:, strcmp(names, name));
  if isempty(column('re_vv')) || isempty(column('freq_hz'))
    error('raytube:read', '%s: is no rcs.csv of raytube', file);
  end
  frequencies = find([false; values(2:end, 1) == values(1, 1)], 1) - 1;  % until the first one comes again
  if isempty(frequencies)
    frequencies = size(values, 1);
  end
  looks = size(values, 1) / frequencies;
  if looks ~= round(looks)
    error('raytube:read', '%s: its rows are not every look at every frequency', file);
  end
  result.frequency_hz = values(1:frequencies, 1);
  for name = {'theta_deg', 'phi_deg', 'rx_theta_deg', 'rx_phi_deg', 'range_m', 'rx_range_m', 'time_s'}
    if any(strcmp(names, name{1}))
      all_rows = column(name{1});
      result.(name{1}) = all_rows(1:frequencies:end);
    end
  end
  result.S = complex(zeros(looks, frequencies, 2, 2));
  channels = {'vv', 'vh'; 'hv', 'hh'};
  for p = 1:2
    for q = 1:2
      by_look = @(name) reshape(column(name), frequencies, looks).';
      pq = channels{p, q};
      result.S(:, :, p, q) = complex(by_look(['re_', pq]), by_look(['im_', pq]));
      result.sigma_dbsm(:, :, p, q) = by_look(['sigma_', pq, '_dbsm']);
      result.err_db(:, :, p, q) = by_look(['err_', pq, '_db']);
      result.model_db(:, :, p, q) = by_look(['model_', pq, '_db']);
    end
  end
  result.attributes.conventions = text(1:sum(cellfun(@numel, lines(1:comments))) + comments);
end
