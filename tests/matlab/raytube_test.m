% Reads what raytube has written, by netCDF and by table, and draws it. Run by run.py in Octave, in a folder that holds
% far/rcs.nc, far/rcs.csv (a sweep of frequencies with mechanisms) and near/rcs.nc, near/rcs.csv (bistatic, at a finite distance).
% Numbers must be equal to the last bit: both files say the same doubles.
function raytube_test()
  for folder = {'far', 'near'}
    netcdf = raytube_read([folder{1}, '/rcs.nc']);
    table = raytube_read([folder{1}, '/rcs.csv']);
    for name = fieldnames(table)'
      if ~strcmp(name{1}, 'attributes')
        require(isequal(netcdf.(name{1}), table.(name{1})), [folder{1}, ': ', name{1}]);
      end
    end
    require(strcmp(netcdf.attributes.conventions, table.attributes.conventions), 'the conventions');
    difference = sigma_of(netcdf.S) - netcdf.sigma_dbsm;  % NaN where both are -Inf
    require(max(abs(difference(:))) < 1e-9, 'sigma is that of S');  % rounding of a logarithm
  end
  test_shape();
  test_mechanisms();
  test_errors();
  fprintf('read\n');
  test_plots();
  fprintf('drawn\n');
end

function sigma = sigma_of(S)
  sigma = 20 * log10(abs(S)) + 10 * log10(4 * pi);
end

% The rows of the table are looks slowest, frequency fastest; the columns name receive first.
function test_shape()
  result = raytube_read('far/rcs.nc');
  require(isequal(size(result.S), [3, 2, 2, 2]), 'three looks at two frequencies');
  require(isequal(result.frequency_hz, [9e9; 10e9]), 'the frequencies');
  require(isequal(result.phi_deg, [0; 5; 10]), 'the angles');
  require(~isfield(result, 'range_m'), 'no range at infinity');
  rows = dlmread('rows.csv', ',', 1, 0);
  require(isequal(result.S(2, 1, 1, 2), complex(rows(3, 8), rows(3, 9))), 'S_vh of look 2 at the first frequency');
  near = raytube_read('near/rcs.nc');
  require(isequal(near.range_m, 3 * ones(size(near.phi_deg))), 'the range');
  require(strcmp(near.attributes.geometry, 'bistatic'), 'bistatic');
end

function test_mechanisms()
  result = raytube_read('far/rcs.nc');
  sum_of_mechanisms = zeros(size(result.S));
  for name = fieldnames(result.mechanism)'
    sum_of_mechanisms = sum_of_mechanisms + result.mechanism.(name{1});
  end
  difference = norm(sum_of_mechanisms(:) - result.S(:)) / norm(result.S(:));
  require(difference < 1e-14, 'mechanisms add up to S');  % rounding of a sum of a few terms
  require(isfield(result, 'model_part') && isfield(result, 'model_m'), 'the model uncertainty');
end

function test_errors()
  try
    raytube_read('missing.nc');
    require(false, 'a missing file is refused');
  catch failure
    require(~isempty(strfind(failure.message, 'no such file')), failure.message);
  end
end

function test_plots()
  graphics_toolkit('gnuplot');
  figure('visible', 'off');
  raytube_plot('near/rcs.csv');
  print('-dsvg', 'lines.svg');
  figure('visible', 'off');
  raytube_plot('far/rcs.nc', 'hh');
  print('-dsvg', 'map.svg');
end

function require(holds, what)
  if ~holds
    error('raytube:test', '%s', what);
  end
end
